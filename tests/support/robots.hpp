// A small made-up robot with every kind of joint, and random configurations of any robot.
#pragma once

#include <memory>
#include <string>

#include "support/fixtures.hpp"

namespace mamo::fixtures {

/// Uniform within the limits; joints without limits within pi.
inline Eigen::VectorXd random_configuration(const Robot& robot, RandomStream& random) {
  Eigen::VectorXd q(robot.dof());
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& j = robot.joint(i);
    const bool limited = std::isfinite(j.lower);
    q[i] = random.uniform(limited ? j.lower : -std::numbers::pi, limited ? j.upper : std::numbers::pi);
  }
  return q;
}

inline Eigen::Isometry3d random_pose(RandomStream& random, double half_width) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
                   .normalized()
                   .toRotationMatrix();
  for (int k = 0; k < 3; ++k) X.translation()[k] = random.uniform(-half_width, half_width);
  return X;
}

/// base - lift (prismatic, oblique) - swing (revolute, oblique axis) - slide (prismatic) - mirror (mimics swing)
/// - spin (continuous) - finger (mimics slide, off the tip's chain) and a parked flap. Offsets are rotated too.
inline Robot made_up_robot() {
  auto model = std::make_shared<RobotModel>();
  model->name = "made_up";
  model->links.push_back({"base", JointId{-1}, {{Box{{0.3, 0.3, 0.1}}, at(0, 0, 0)}}, {}, 0});
  RandomStream random(7, {});
  const auto add = [&](const char* name, LinkId parent, JointType type, Eigen::Vector3d axis, double lower,
                       double upper, std::optional<Mimic> mimic, std::vector<PlacedShape> shapes) {
    Joint j;
    j.name = name;
    j.type = type;
    j.parent = parent;
    j.child = LinkId(model->links.size());
    j.X_PJ = random_pose(random, 0.2);
    j.axis = axis.normalized();
    j.lower = lower;
    j.upper = upper;
    j.mimic = mimic;
    if (type != JointType::fixed && !mimic) {
      j.variable = model->variables++;
      model->variable_joint.push_back(JointId(model->joints.size()));
    }
    model->links.push_back({std::string(name) + "_link", JointId(model->joints.size()), shapes, {}, 1.0});
    model->joints.push_back(j);
    return j.child;
  };
  const double inf = std::numeric_limits<double>::infinity();
  const LinkId lift =
      add("lift", LinkId{0}, JointType::prismatic, {0.2, 0.1, 1}, 0, 0.4, {}, {{Box{{0.1, 0.1, 0.2}}, at(0, 0, 0.1)}});
  const LinkId swing =
      add("swing", lift, JointType::revolute, {1, -1, 0.5}, -2, 2, {}, {{Cylinder{0.04, 0.3}, lying(0.15, 0, 0)}});
  const LinkId slide =
      add("slide", swing, JointType::prismatic, {1, 0, 0}, -0.1, 0.2, {}, {{Box{{0.2, 0.05, 0.05}}, at(0.1, 0, 0)}});
  const LinkId mirror = add("mirror", slide, JointType::revolute, {0, 1, 0}, -2, 2, Mimic{JointId{1}, -0.5, 0.3},
                            {{Sphere{0.05}, at(0, 0.02, 0)}});
  const LinkId spin =
      add("spin", mirror, JointType::continuous, {0, 0, 1}, -inf, inf, {}, {{Box{{0.1, 0.2, 0.03}}, at(0.05, 0, 0)}});
  add("finger", spin, JointType::prismatic, {0, 1, 0}, -0.3, 0.3, Mimic{JointId{2}, 1.0, 0.05},
      {{Box{{0.05, 0.02, 0.02}}, at(0.1, 0, 0)}});
  add("flap", spin, JointType::revolute, {0, 1, 0}, -1, 1, {}, {{Box{{0.05, 0.02, 0.02}}, at(0, 0.1, 0)}});
  const LinkId tool = add("tool", spin, JointType::fixed, {1, 0, 0}, 0, 0, {}, {});
  Robot robot;
  robot.model = model;
  for (const char* name : {"lift", "swing", "slide", "spin"}) robot.group.joints.push_back(model->find_joint(name));
  robot.group.base = LinkId{0};
  robot.group.tip = tool;
  robot.posture = Eigen::VectorXd::Constant(model->variables, 0.1);
  robot.X_WB = at(0.1, -0.2, 0.3, 0.7);
  return robot;
}

}  // namespace mamo::fixtures
