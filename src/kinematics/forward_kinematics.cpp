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
    step.type = j.type;
    step.group_index = group_index[j.mimic ? j.mimic->joint.index() : i];
    step.multiplier = j.mimic ? j.mimic->multiplier : 1.0;
    step.offset = j.mimic ? j.mimic->offset : 0.0;
    if (step.group_index < 0) step.X_PJ = j.X_PJ * joint_motion(j.type, j.axis, value), step.type = JointType::fixed;
    steps_.push_back(step);
  }
}

void ForwardKinematics::link_poses(const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) const {
  if (X_WL.size() != rest_.size()) X_WL = rest_;
  for (const Step& s : steps_) {
    const Eigen::Isometry3d& parent = X_WL[static_cast<std::size_t>(s.parent)];
    Eigen::Isometry3d& child = X_WL[static_cast<std::size_t>(s.link)];
    const Eigen::Matrix3d R = parent.linear() * s.X_PJ.linear();
    child.translation().noalias() = parent.linear() * s.X_PJ.translation() + parent.translation();
    if (s.type == JointType::fixed) {
      child.linear() = R;
      continue;
    }
    const double value = s.multiplier * q[s.group_index] + s.offset;
    if (s.type == JointType::prismatic) {
      child.linear() = R;
      child.translation().noalias() += R * (value * s.axis);
    } else {
      child.linear().noalias() = R * Eigen::AngleAxisd(value, s.axis).toRotationMatrix();
    }
  }
}

Eigen::Isometry3d ForwardKinematics::link_pose(const Eigen::VectorXd& q, LinkId link) const {
  std::vector<Eigen::Isometry3d> X_WL;
  link_poses(q, X_WL);
  return X_WL[link.index()];
}

Eigen::Isometry3d ForwardKinematics::tip_pose(const Eigen::VectorXd& q) const { return link_pose(q, robot_.group.tip); }

void ForwardKinematics::jacobian(const Eigen::VectorXd& q, Eigen::Matrix<double, 6, Eigen::Dynamic>& J) const {
  std::vector<Eigen::Isometry3d> X_WL;
  link_poses(q, X_WL);
  J.setZero(6, robot_.dof());
  const Eigen::Vector3d tip = X_WL[robot_.group.tip.index()].translation();
  // Walk from the tip to the root; a joint's axis in world is that of its child link.
  const RobotModel& model = *robot_.model;
  for (LinkId link = robot_.group.tip; model.links[link.index()].parent_joint.valid();) {
    const JointId id = model.links[link.index()].parent_joint;
    const Joint& j = model.joints[id.index()];
    const JointId driver = j.mimic ? j.mimic->joint : id;
    const double k = j.mimic ? j.mimic->multiplier : 1.0;
    for (int i = 0; i < robot_.dof(); ++i) {
      if (robot_.group.joints[static_cast<std::size_t>(i)] != driver || j.type == JointType::fixed) continue;
      const Eigen::Vector3d axis = X_WL[link.index()].linear() * j.axis;
      if (j.type == JointType::prismatic) {
        J.col(i).head<3>() += k * axis;
      } else {
        J.col(i).head<3>() += k * axis.cross(tip - X_WL[link.index()].translation());
        J.col(i).tail<3>() += k * axis;
      }
    }
    link = j.parent;
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
    if (j.type == JointType::prismatic) reach += std::max(std::abs(j.lower), std::abs(j.upper));
    reach += j.X_PJ.translation().norm();
    link = j.parent;
  }
  return bound;
}

}  // namespace mamo
