#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo {
namespace {

Eigen::Isometry3d joint_motion(JointType type, const Eigen::Vector3d& axis, double value) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (type == JointType::prismatic)
    X.translation() = value * axis;
  else if (type != JointType::fixed)
    X.linear() = Eigen::AngleAxisd(value, axis).toRotationMatrix();
  return X;
}

double largest_norm(const std::vector<PlacedShape>& shapes) {
  double largest = 0;
  for (const PlacedShape& s : shapes) {
    const Eigen::AlignedBox3d box = bounds(s.shape, s.X_BS);
    largest = std::max(largest, box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm());
  }
  return largest;
}

}  // namespace

ForwardKinematics::ForwardKinematics(const Robot& robot) : robot_(robot) {
  const RobotModel& model = *robot_.model;
  std::vector<int> group_index(model.joints.size(), -1);
  for (int i = 0; i < robot_.dof(); ++i) group_index[robot_.group.joints[static_cast<std::size_t>(i)].index()] = i;
  const std::vector<bool> moving = robot_.moving_links();

  std::vector<bool> above_tip(model.links.size(), false);
  for (LinkId link = robot_.group.tip; link.valid();) {
    above_tip[link.index()] = true;
    const JointId up = model.links[link.index()].parent_joint;
    link = up.valid() ? model.joints[up.index()].parent : LinkId{-1};
  }

  rest_.resize(model.links.size(), Eigen::Isometry3d::Identity());
  rest_[0] = robot_.X_WB;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& j = model.joints[i];
    const Joint& source = j.mimic ? model.joints[j.mimic->joint.index()] : j;
    double value = source.variable >= 0 ? robot_.posture[source.variable] : 0.0;
    if (j.mimic) value = j.mimic->multiplier * value + j.mimic->offset;
    rest_[j.child.index()] = rest_[j.parent.index()] * j.X_PJ * joint_motion(j.type, j.axis, value);
    if (!moving[j.child.index()]) continue;

    Step step;
    step.link = j.child.value;
    step.parent = j.parent.value;
    step.X_PJ = j.X_PJ;
    step.axis = j.axis;
    step.group_index = group_index[j.mimic ? j.mimic->joint.index() : i];
    step.multiplier = j.mimic ? j.mimic->multiplier : 1.0;
    step.offset = j.mimic ? j.mimic->offset : 0.0;
    step.motion = Motion::none;
    if (step.group_index < 0)
      step.X_PJ = j.X_PJ * joint_motion(j.type, j.axis, value);
    else if (j.type == JointType::prismatic)
      step.motion = Motion::along_axis;
    else if (j.type != JointType::fixed)
      step.motion = j.axis == Eigen::Vector3d::UnitX()   ? Motion::about_x
                    : j.axis == Eigen::Vector3d::UnitY() ? Motion::about_y
                    : j.axis == Eigen::Vector3d::UnitZ() ? Motion::about_z
                                                         : Motion::about_axis;
    step.rotated = step.X_PJ.linear() != Eigen::Matrix3d::Identity();
    steps_.push_back(step);
    if (!above_tip[j.child.index()]) continue;
    tip_steps_.push_back(step);
    if (step.motion != Motion::none)
      chain_.push_back({step.link, step.group_index, step.multiplier, step.motion == Motion::along_axis, step.axis});
  }
}

// A rotation about a coordinate axis leaves that column and turns the other two: a third of the work of a
// matrix product, and no axis-angle formula.
void ForwardKinematics::take(const Step& s, const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) {
  const auto parent = X_WL[static_cast<std::size_t>(s.parent)].matrix();
  auto& child = X_WL[static_cast<std::size_t>(s.link)].matrix();
  Eigen::Matrix3d R = parent.topLeftCorner<3, 3>();
  Eigen::Vector3d p = R * s.X_PJ.translation() + parent.topRightCorner<3, 1>();
  if (s.rotated) R = (R * s.X_PJ.linear()).eval();

  const double value = s.motion == Motion::none ? 0.0 : s.multiplier * q[s.group_index] + s.offset;
  const auto turn = [&](int from, int to) {  // columns `from` -> c from + s to, `to` -> c to - s from
    const double c = std::cos(value), sine = std::sin(value);
    const Eigen::Vector3d a = R.col(from), b = R.col(to);
    R.col(from) = c * a + sine * b;
    R.col(to) = c * b - sine * a;
  };
  switch (s.motion) {
    case Motion::none:
      break;
    case Motion::about_x:
      turn(1, 2);
      break;
    case Motion::about_y:
      turn(2, 0);
      break;
    case Motion::about_z:
      turn(0, 1);
      break;
    case Motion::about_axis:
      R = (R * Eigen::AngleAxisd(value, s.axis).toRotationMatrix()).eval();
      break;
    case Motion::along_axis:
      p += R * (value * s.axis);
      break;
  }
  child.topLeftCorner<3, 3>() = R;
  child.topRightCorner<3, 1>() = p;
}

void ForwardKinematics::link_poses(const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) const {
  if (X_WL.size() != rest_.size()) X_WL = rest_;
  for (const Step& s : steps_) take(s, q, X_WL);
}

void ForwardKinematics::chain_poses(const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) const {
  if (X_WL.size() != rest_.size()) X_WL = rest_;
  for (const Step& s : tip_steps_) take(s, q, X_WL);
}

Eigen::Isometry3d ForwardKinematics::link_pose(const Eigen::VectorXd& q, LinkId link) const {
  std::vector<Eigen::Isometry3d> X_WL;
  link_poses(q, X_WL);
  return X_WL[link.index()];
}

Eigen::Isometry3d ForwardKinematics::tip_pose(const Eigen::VectorXd& q) const {
  std::vector<Eigen::Isometry3d> X_WL;
  chain_poses(q, X_WL);
  return X_WL[robot_.group.tip.index()];
}

void ForwardKinematics::jacobian(const Eigen::VectorXd& q, Eigen::Matrix<double, 6, Eigen::Dynamic>& J) const {
  std::vector<Eigen::Isometry3d> X_WL;
  chain_poses(q, X_WL);
  jacobian(X_WL, J);
}

void ForwardKinematics::jacobian(const std::vector<Eigen::Isometry3d>& X_WL,
                                 Eigen::Matrix<double, 6, Eigen::Dynamic>& J) const {
  J.setZero(6, robot_.dof());
  const Eigen::Vector3d tip = X_WL[robot_.group.tip.index()].translation();
  for (const ChainJoint& c : chain_) {  // a mimic joint adds to its driver's column
    const Eigen::Isometry3d& X = X_WL[static_cast<std::size_t>(c.link)];
    const Eigen::Vector3d axis = c.multiplier * (X.linear() * c.axis);
    if (c.prismatic) {
      J.col(c.group_index).head<3>() += axis;
    } else {
      J.col(c.group_index).head<3>() += axis.cross(tip - X.translation());
      J.col(c.group_index).tail<3>() += axis;
    }
  }
}

Eigen::VectorXd ForwardKinematics::motion_bounds() const {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(robot_.dof());
  const std::vector<bool> moving = robot_.moving_links();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i] || robot_.model->links[i].collision.empty()) continue;
    const double r = largest_norm(robot_.model->links[i].collision);
    largest = largest.cwiseMax(motion_bounds(LinkId(i), Eigen::Vector3d(r, 0, 0)));
  }
  return largest;
}

Eigen::VectorXd ForwardKinematics::motion_bounds(LinkId link, const Eigen::Vector3d& p_L) const {
  // Triangle inequality along the chain: distance from a joint's axis to the point is at most the sum of the
  // offsets in between (plus the travel of prismatic joints in between).
  const RobotModel& model = *robot_.model;
  const auto largest_travel = [&](const Joint& j) {
    const Joint& driver = j.mimic ? model.joints[j.mimic->joint.index()] : j;
    const double k = j.mimic ? j.mimic->multiplier : 1.0, offset = j.mimic ? j.mimic->offset : 0.0;
    return std::max(std::abs(k * driver.lower + offset), std::abs(k * driver.upper + offset));
  };
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(robot_.dof());
  double reach = p_L.norm();
  while (model.links[link.index()].parent_joint.valid()) {
    const JointId id = model.links[link.index()].parent_joint;
    const Joint& j = model.joints[id.index()];
    const JointId driver = j.mimic ? j.mimic->joint : id;
    const double k = std::abs(j.mimic ? j.mimic->multiplier : 1.0);
    for (int i = 0; i < robot_.dof(); ++i)
      if (robot_.group.joints[static_cast<std::size_t>(i)] == driver && j.type != JointType::fixed)
        bound[i] += k * (j.type == JointType::prismatic ? 1.0 : reach);
    if (j.type == JointType::prismatic) reach += largest_travel(j);
    reach += j.X_PJ.translation().norm();
    link = j.parent;
  }
  return bound;
}

}  // namespace mamo
