// A gantry with a finger, and scenes on a table: physics tests push exactly what they mean to push.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/motion.hpp"
#include "mamo/physics/evaluation.hpp"
#include "support/fixtures.hpp"

namespace mamo::pushing {

using fixtures::at;

/// Joints x, y, z (prismatic, m): the finger's centre in world. The finger is a sphere of 2 cm radius.
inline std::shared_ptr<const ForwardKinematics> gantry(std::vector<PlacedShape> finger = {{Sphere{0.02}, at(0, 0, 0)}}) {
  auto model = std::make_shared<RobotModel>();
  model->name = "gantry";
  model->links.push_back({"base", JointId{-1}, {}, {}, 0});
  const std::vector<Eigen::Vector3d> axes = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  for (int i = 0; i < 3; ++i) {
    Joint j;
    j.name = std::string(1, static_cast<char>('x' + i));
    j.type = JointType::prismatic;
    j.parent = LinkId{i};
    j.child = LinkId{i + 1};
    j.axis = axes[static_cast<std::size_t>(i)];
    j.lower = -3;
    j.upper = 3;
    j.max_velocity = 1;
    j.variable = model->variables++;
    model->variable_joint.push_back(JointId(i));
    model->links.push_back({"link_" + j.name, JointId(i), {}, {}, 1.0});
    model->joints.push_back(j);
  }
  model->links.back().collision = std::move(finger);
  Robot robot;
  robot.model = model;
  robot.group.joints = model->variable_joint;
  robot.group.base = LinkId{0};
  robot.group.tip = LinkId{3};
  robot.posture = Eigen::Vector3d(0, 0, 1);
  robot.speed_scale = 0.1;  // 0.1 m/s per axis
  return std::make_shared<ForwardKinematics>(robot);
}

/// Along the points (finger centre, m), at most 0.1 m/s per axis unless another speed is given.
inline TimedPath along(const std::vector<Eigen::Vector3d>& points, double step_s = 1.0 / 120, double speed = 0.1) {
  Robot robot = gantry()->robot();
  robot.speed_scale = speed;
  return time_path(robot, {points.begin(), points.end()}, step_s);
}

/// A table of 2 x 2 m whose top is at z = 0.5.
inline constexpr double kTop = 0.5;
inline Scene table() {
  Scene scene;
  scene.objects = {fixtures::fixture_box("table", {0, 0, kTop - 0.05}, {2, 2, 0.1}, Touch::support)};
  return scene;
}

inline ObjectId add(Scene& scene, const Object& object) {
  scene.objects.push_back(object);
  return ObjectId(scene.size() - 1);
}

inline Object can(const std::string& id, double x, double y, double radius = 0.035, double length = 0.1,
                  double mass = 0.3, double friction = 0.5) {
  return fixtures::standing_cylinder(id, x, y, radius, length, ObjectKind::movable, mass, friction, kTop);
}

inline Object block(const std::string& id, double x, double y, const Eigen::Vector3d& size = {0.06, 0.06, 0.06},
                    double mass = 0.3, double friction = 0.5) {
  Object o = can(id, x, y, 0.03, size.z(), mass, friction);
  o.shapes = {{Box{size}, Eigen::Isometry3d::Identity()}};
  return o;
}

/// Evaluates one motion from the scene's start with every object present.
struct Bench {
  Scene scene;
  std::shared_ptr<const ForwardKinematics> kinematics = gantry();

  Evaluation evaluate(const TimedPath& motion) const {
    EvaluationRequest request;
    return evaluate(motion, request);
  }
  Evaluation evaluate(const TimedPath& motion, EvaluationRequest request) const {
    const ObjectSet all = ObjectSet::all(scene);
    const WorldState start = WorldState::start_of(scene);
    if (!request.present) request.present = &all;
    if (!request.from) request.from = &start;
    request.motion = &motion;
    return Evaluator(kinematics, scene).evaluate(request);
  }
};

}  // namespace mamo::pushing
