#include "arm_travel.hpp"

namespace mamo::collision {
namespace {

/// Distance of a point from a line through o along the unit vector a.
inline double distance_to_line(const Eigen::Vector3d& p, const Eigen::Vector3d& o, const Eigen::Vector3d& a) {
  return a.cross(p - o).norm();
}

/// Upper bound on the distance of any point of a solid at X from a line.
double lever_of(const Solid& solid, const Eigen::Isometry3d& X, const Eigen::Vector3d& o, const Eigen::Vector3d& a) {
  const double ball = distance_to_line(X.translation(), o, a) + solid.radius;
  double corners = 0;
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3d corner((c & 1 ? 1 : -1) * solid.half.x(), (c & 2 ? 1 : -1) * solid.half.y(),
                                 (c & 4 ? 1 : -1) * solid.half.z());
    corners = std::max(corners, distance_to_line(X * corner, o, a));
  }
  double lever = std::min(ball, corners);
  if (solid.kind == Solid::Kind::cylinder) {  // discs at both ends
    const Eigen::Vector3d end = X.linear().col(2) * solid.half.z();
    lever = std::min(lever, solid.half.x() + std::max(distance_to_line(X.translation() + end, o, a),
                                                      distance_to_line(X.translation() - end, o, a)));
  }
  return lever;
}

double largest_travel(const RobotModel& model, const Joint& j) {
  const Joint& driver = j.mimic ? model.joints[j.mimic->joint.index()] : j;
  const double k = j.mimic ? j.mimic->multiplier : 1.0, offset = j.mimic ? j.mimic->offset : 0.0;
  return std::max(std::abs(k * driver.lower + offset), std::abs(k * driver.upper + offset));
}

}  // namespace

ArmTravel::ArmTravel(const Robot& robot) : robot_(robot) {
  const RobotModel& model = *robot_.model;
  std::vector<int> group_index(model.joints.size(), -1);
  for (int i = 0; i < robot_.dof(); ++i) group_index[robot_.group.joints[static_cast<std::size_t>(i)].index()] = i;
  actuator_of_link_.assign(model.links.size(), -1);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& j = model.joints[i];
    const int driver = group_index[j.mimic ? j.mimic->joint.index() : i];
    if (driver < 0 || j.type == JointType::fixed) continue;
    actuator_of_link_[j.child.index()] = static_cast<int>(actuators_.size());
    actuators_.push_back({j.child.value, driver, std::abs(j.mimic ? j.mimic->multiplier : 1.0), j.axis});
  }
}

int ArmTravel::add_part(LinkId link, const Solid& solid, const Eigen::Isometry3d& X_LS) {
  const RobotModel& model = *robot_.model;
  Part part;
  part.link = link.value;
  part.p_L = X_LS.translation();
  part.radius = solid.radius;
  // Up the chain. As long as no driven joint lies in between, the part's pose in the current link is known and so
  // is the lever; further up, offsets add to the reach.
  Eigen::Isometry3d X_PS = X_LS;
  double reach = X_LS.translation().norm() + solid.radius;
  while (model.links[link.index()].parent_joint.valid()) {
    const Joint& j = model.joints[model.links[link.index()].parent_joint.index()];
    const int actuator = actuator_of_link_[link.index()];
    if (actuator >= 0) {
      const double known = part.levers.empty() ? lever_of(solid, X_PS, Eigen::Vector3d::Zero(), j.axis) : reach;
      const bool slides = j.type == JointType::prismatic;
      part.levers.push_back({actuator, slides ? 1.0 : std::min(reach, known), slides || part.levers.empty()});
      if (j.type == JointType::prismatic) reach += largest_travel(model, j);
      reach += j.X_PJ.translation().norm();
    } else {
      double value = j.variable >= 0 ? robot_.posture[j.variable] : 0.0;
      if (j.mimic) {
        const int driver = model.joints[j.mimic->joint.index()].variable;
        value = j.mimic->multiplier * (driver >= 0 ? robot_.posture[driver] : 0.0) + j.mimic->offset;
      }
      Eigen::Isometry3d X_PL = j.X_PJ;
      if (j.type == JointType::prismatic)
        X_PL.translate(value * j.axis);
      else if (j.type != JointType::fixed)
        X_PL.rotate(Eigen::AngleAxisd(value, j.axis));
      X_PS = X_PL * X_PS;
      reach += X_PL.translation().norm();
      if (part.levers.empty()) reach = std::min(reach, X_PS.translation().norm() + solid.radius);
    }
    link = j.parent;
  }
  parts_.push_back(std::move(part));
  return static_cast<int>(parts_.size()) - 1;
}

int ArmTravel::add_pair(int a, int b) {
  const auto& la = parts_[static_cast<std::size_t>(a)].levers;
  const auto& lb = parts_[static_cast<std::size_t>(b)].levers;
  std::size_t shared = 0;  // both lists end at the root
  while (shared < la.size() && shared < lb.size() &&
         la[la.size() - 1 - shared].actuator == lb[lb.size() - 1 - shared].actuator)
    ++shared;
  pairs_.push_back({a, b, shared});
  return static_cast<int>(pairs_.size()) - 1;
}

void ArmTravel::update(const std::vector<Eigen::Isometry3d>& X_WL, const Eigen::VectorXd& dq, double half_stretch) {
  for (Actuator& m : actuators_) {
    m.rate = m.multiplier * std::abs(dq[m.group_index]);
    const Eigen::Isometry3d& X = X_WL[static_cast<std::size_t>(m.link)];
    m.axis_W.noalias() = X.linear() * m.axis;
    m.p_W = X.translation();
  }
  for (Part& part : parts_) {
    const Eigen::Isometry3d& X = X_WL[static_cast<std::size_t>(part.link)];
    const Eigen::Vector3d centre = X.linear() * part.p_L + X.translation();
    double drift = 0;  // how much the joints passed so far can lengthen a lever within the stretch
    part.speed = 0;
    for (Lever& lever : part.levers) {
      const Actuator& m = actuators_[static_cast<std::size_t>(lever.actuator)];
      lever.speed = 0;
      if (m.rate == 0) continue;
      double arm = lever.largest;
      if (!lever.constant) arm = std::min(arm, distance_to_line(centre, m.p_W, m.axis_W) + part.radius + drift);
      lever.speed = m.rate * arm;
      part.speed += lever.speed;
      drift += m.rate * lever.largest * half_stretch;
    }
  }
}

double ArmTravel::pair_speed(int pair) const {
  const Pair& p = pairs_[static_cast<std::size_t>(pair)];
  double speed = 0;
  for (int end : {p.a, p.b}) {
    const auto& levers = parts_[static_cast<std::size_t>(end)].levers;
    for (std::size_t k = 0; k + p.shared < levers.size(); ++k) speed += levers[k].speed;
  }
  return speed;
}

double ArmTravel::largest_speed() const {
  double largest = 0;
  for (const Part& part : parts_) largest = std::max(largest, part.speed);
  return largest;
}

double ArmTravel::worst_speed(const Eigen::VectorXd& dq) const {
  double largest = 0;
  for (const Part& part : parts_) {
    double speed = 0;
    for (const Lever& lever : part.levers) {
      const Actuator& actuator = actuators_[static_cast<std::size_t>(lever.actuator)];
      speed += lever.largest * actuator.multiplier * std::abs(dq[actuator.group_index]);
    }
    largest = std::max(largest, speed);
  }
  return largest;
}

}  // namespace mamo::collision
