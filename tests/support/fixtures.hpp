// A PR2-like right arm and the published shelf, built in code: tests of low modules need no file.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "mamo/common/random.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo::fixtures {

inline Eigen::Isometry3d at(double x, double y, double z, double yaw = 0) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(x, y, z);
  X.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return X;
}

/// x along the cylinder's axis instead of z.
inline Eigen::Isometry3d lying(double x, double y, double z) {
  Eigen::Isometry3d X = at(x, y, z);
  X.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return X;
}

/// Joint chain and limits of the PR2's right arm at torso 0.1 (EM4M_FACTS section 8), primitive shapes.
inline Robot pr2_like_arm() {
  auto model = std::make_shared<RobotModel>();
  model->name = "pr2_like";
  model->links.push_back({"base", JointId{-1}, {}, {}, 0});
  struct Row {
    const char* joint;
    const char* link;
    Eigen::Vector3d offset;
    JointType type;
    Eigen::Vector3d axis;
    double lower, upper, velocity;
    std::vector<PlacedShape> shapes;
  };
  const Eigen::Vector3d X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY(), Z = Eigen::Vector3d::UnitZ();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Row> rows = {
      {"torso_fixed", "torso", {-0.05, 0, 0.890675}, JointType::fixed, X, 0, 0, 1, {{Box{{0.3, 0.4, 0.6}}, at(-0.1, 0, -0.2)}}},
      {"shoulder_pan", "shoulder_pan_link", {0, -0.188, 0}, JointType::revolute, Z, -2.2854, 0.7146, 2.088,
       {{Cylinder{0.12, 0.3}, at(0, 0, -0.1)}}},
      {"shoulder_lift", "shoulder_lift_link", {0.1, 0, 0}, JointType::revolute, Y, -0.5236, 1.3963, 2.082, {}},
      {"upper_arm_roll", "upper_arm_link", {0, 0, 0}, JointType::revolute, X, -3.9, 0.8, 3.27,
       {{Cylinder{0.08, 0.4}, lying(0.2, 0, 0)}}},
      {"elbow_flex", "elbow_link", {0.4, 0, 0}, JointType::revolute, Y, -2.3213, 0, 3.3, {{Sphere{0.08}, at(0, 0, 0)}}},
      {"forearm_roll", "forearm_link", {0, 0, 0}, JointType::continuous, X, -inf, inf, 3.6,
       {{Cylinder{0.06, 0.22}, lying(0.22, 0, 0)}}},
      {"wrist_flex", "wrist_flex_link", {0.321, 0, 0}, JointType::revolute, Y, -2.18, 0, 3.078, {{Sphere{0.04}, at(0, 0, 0)}}},
      {"wrist_roll", "palm", {0, 0, 0}, JointType::continuous, X, -inf, inf, 3.6,
       {{Box{{0.096, 0.101, 0.049}}, at(0.077, 0, 0)}}},
      {"l_finger_fixed", "l_finger", {0.07691, 0.01, 0}, JointType::fixed, X, 0, 0, 1, {{Box{{0.104, 0.04, 0.04}}, at(0.043, 0.018, 0)}}},
      {"r_finger_fixed", "r_finger", {0.07691, -0.01, 0}, JointType::fixed, X, 0, 0, 1, {{Box{{0.104, 0.04, 0.04}}, at(0.043, -0.018, 0)}}},
      {"tool_fixed", "tool", {0.18, 0, 0}, JointType::fixed, X, 0, 0, 1, {}},
  };
  LinkId parent{0};
  LinkId palm;
  for (const Row& row : rows) {
    Joint j;
    j.name = row.joint;
    j.type = row.type;
    const std::string name = row.link;
    const bool on_palm = name == "l_finger" || name == "r_finger" || name == "tool";
    j.parent = on_palm ? palm : parent;
    j.child = LinkId(model->links.size());
    j.X_PJ = at(row.offset.x(), row.offset.y(), row.offset.z());
    j.axis = row.axis;
    j.lower = row.lower;
    j.upper = row.upper;
    j.max_velocity = row.velocity;
    if (row.type != JointType::fixed) {
      j.variable = model->variables++;
      model->variable_joint.push_back(JointId(model->joints.size()));
    }
    model->links.push_back({name, JointId(model->joints.size()), row.shapes, {}, 1.0});
    model->joints.push_back(j);
    parent = j.child;
    if (name == "palm") palm = j.child;
  }
  Robot robot;
  robot.model = model;
  robot.group.joints = model->variable_joint;
  robot.group.base = LinkId{0};
  robot.group.tip = model->find_link("tool");
  robot.posture.resize(7);
  robot.posture << -1.68651, -0.184315, -1.67611, -1.66215, 0.285096, -0.658798, 1.41563;  // home
  const auto pair = [&](const char* a, const char* b) {
    robot.self_pairs.emplace_back(std::min(model->find_link(a), model->find_link(b)),
                                  std::max(model->find_link(a), model->find_link(b)));
  };
  for (const char* outer : {"forearm_link", "wrist_flex_link", "palm", "l_finger", "r_finger"})
    for (const char* inner : {"torso", "shoulder_pan_link"}) pair(inner, outer);
  return robot;
}

inline Object fixture_box(const std::string& id, const Eigen::Vector3d& centre, const Eigen::Vector3d& size, Touch touch) {
  Object o;
  o.id = id;
  o.kind = ObjectKind::fixture;
  o.shapes = {{Box{size}, Eigen::Isometry3d::Identity()}};
  o.X_WO = at(centre.x(), centre.y(), centre.z());
  o.constraints.touch = touch;
  return o;
}

/// The shelf of the published scenes (EM4M_FACTS section 1): base, back, top, right and left wall.
inline Scene shelf() {
  Scene scene;
  scene.objects = {fixture_box("base", {0.78, -0.5, 0.75}, {0.6, 0.8, 0.04}, Touch::support),
                   fixture_box("back", {1.1, -0.5, 0.93}, {0.04, 0.8, 0.4}, Touch::forbidden),
                   fixture_box("top", {0.78, -0.5, 1.11}, {0.6, 0.8, 0.04}, Touch::forbidden),
                   fixture_box("right", {0.8, -0.92, 0.93}, {0.64, 0.04, 0.4}, Touch::forbidden),
                   fixture_box("left", {0.8, -0.08, 0.93}, {0.64, 0.04, 0.4}, Touch::forbidden)};
  return scene;
}

inline Object standing_cylinder(const std::string& id, double x, double y, double radius, double length,
                                ObjectKind kind = ObjectKind::movable, double mass = 0.3, double friction = 0.9,
                                double support_z = 0.77) {
  Object o;
  o.id = id;
  o.kind = kind;
  o.shapes = {{Cylinder{radius, length}, Eigen::Isometry3d::Identity()}};
  o.X_WO = at(x, y, support_z + length / 2);
  o.mass = mass;
  o.friction = friction;
  o.constraints.touch = kind == ObjectKind::movable ? Touch::allowed : Touch::forbidden;
  return o;
}

/// The shelf with `movables` movable and `immovables` immovable things at seeded non-overlapping places
/// (boxes and cylinders in turn, radii 3 to 5 cm). Fewer come if there is no room.
inline Scene cluttered_shelf(int movables, int immovables, std::uint64_t seed) {
  Scene scene = shelf();
  RandomStream random(seed, {0x73686c66});
  struct Disc {
    double x, y, r;
  };
  std::vector<Disc> taken;
  for (int k = 0; k < movables + immovables; ++k) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const double r = random.uniform(0.03, 0.045), half = r / std::numbers::sqrt2;
      const double x = random.uniform(0.54, 1.02), y = random.uniform(-0.84, -0.16);
      bool fits = true;
      for (const Disc& d : taken) fits = fits && std::hypot(d.x - x, d.y - y) > d.r + r + 0.005;
      if (!fits) continue;
      taken.push_back({x, y, r});
      const ObjectKind kind = k < movables ? ObjectKind::movable : ObjectKind::immovable;
      Object o = standing_cylinder("object_" + std::to_string(k), x, y, r, 0.15, kind, random.uniform(0.05, 0.5));
      if (k % 2) {
        o.shapes = {{Box{{2 * half, 2 * half, 0.18}}, Eigen::Isometry3d::Identity()}};
        o.X_WO = at(x, y, 0.77 + 0.09, random.uniform(0, 6.28));
      }
      scene.objects.push_back(o);
      break;
    }
  }
  return scene;
}

}  // namespace mamo::fixtures
