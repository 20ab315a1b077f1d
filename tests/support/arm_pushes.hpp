// Straight pushes of the PR2-like arm through the cluttered shelf: 0.25 m in 2.5 s.
#pragma once

#include <vector>

#include "support/fixtures.hpp"

#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/physics/world.hpp"

namespace mamo::pushing {

struct ArmPush {
  ObjectId object;                 // the one in front of the gripper
  std::vector<Eigen::VectorXd> q;  // 251 configurations, 1 mm and 0.01 s apart
  /// After `time_s`, linear in between.
  Eigen::VectorXd at(double time_s) const {
    const double s = std::clamp(time_s * 100, 0.0, static_cast<double>(q.size() - 1));
    const std::size_t i = std::min(static_cast<std::size_t>(s), q.size() - 2);
    return q[i] + (s - static_cast<double>(i)) * (q[i + 1] - q[i]);
  }
  static constexpr double kDuration = 2.5;  // s
};

/// The tool frame along a line, the wrist staying in one branch; empty when it jumps or leaves the limits.
inline std::vector<Eigen::VectorXd> straight_line(const InverseKinematics& ik, const Robot& robot,
                                                  const Eigen::Isometry3d& from, const Eigen::Vector3d& step) {
  std::vector<Eigen::VectorXd> path;
  Eigen::VectorXd q = robot.group_part(robot.posture);
  Eigen::Isometry3d X = from;
  for (int k = 0; k <= 250; ++k) {
    const auto solved = ik.solve(X, q, 1, {.position_tolerance = 1e-5, .angle_tolerance = 1e-4, .starts = k ? 1 : 30});
    if (!solved || (k && (*solved - q).norm() > 0.05)) return {};
    q = *solved;
    path.push_back(q);
    X.translation() += step;
  }
  return path;
}

/// Pushes that start clear of everything and move the object in front by more than 2 cm.
inline std::vector<ArmPush> arm_pushes(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene,
                                       int count, std::uint64_t seed) {
  const InverseKinematics ik(*kinematics);
  const Robot& robot = kinematics->robot();
  RandomStream random(seed, {0x61726d});
  World world(kinematics, scene);
  const WorldState start = WorldState::start_of(scene);
  const std::vector<ObjectId> movables = ObjectSet::of_kind(scene, ObjectKind::movable).ids();
  std::vector<ArmPush> pushes;
  for (int attempt = 0; attempt < 4000 && static_cast<int>(pushes.size()) < count; ++attempt) {
    ArmPush push;
    push.object = movables[random.below(movables.size())];
    const double heading = random.uniform(-0.6, 0.6);
    const Eigen::Vector3d along(std::cos(heading), std::sin(heading), 0);
    Eigen::Isometry3d X = fixtures::at(0, 0, 0, heading);
    X.translation() = scene[push.object].X_WO.translation() - 0.1 * along;
    X.translation().z() = 0.77 + random.uniform(0.03, 0.05);
    push.q = straight_line(ik, robot, X, 1e-3 * along);
    if (push.q.empty()) continue;
    world.reset(ObjectSet::all(scene), start, push.q.front());
    bool clear = true;
    for (double t = 0.0; t < ArmPush::kDuration; t += scene.physics.step) {
      world.step(push.at(t));
      for (const ObjectId id : movables) clear = clear && !(t < 0.1 && world.awake(id));
    }
    const double moved = (world.X_WO(push.object).translation() - scene[push.object].X_WO.translation()).norm();
    if (clear && moved > 0.02) pushes.push_back(std::move(push));
  }
  return pushes;
}

}  // namespace mamo::pushing
