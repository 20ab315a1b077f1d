// The fixture arm reaching over a table, and hand-made plans: a sweep turns the shoulder, so the hand runs along a
// circle at constant height and hits what stands in its way.
//
//      y                     . hand at pan +0.4
//      |      ___________ .        the table's top is at z = 0.77, the fingers run at 0.83 to 0.89
//   shoulder +----------. can      the circle about the shoulder has a radius of 0.96 m
//      |      ~~~~~~~~~~~ '
//      +---x               ' hand at pan -0.6
#pragma once

#include <numbers>

#include "support/fixtures.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/planner.hpp"

namespace mamo::fixtures {

inline Eigen::VectorXd over_table(double pan, double lift = -0.3) {
  Eigen::VectorXd q(7);
  q << pan, lift, -std::numbers::pi, -0.6, 0, 0, 0;
  return q;
}

/// Table, arm at pan -0.6, task: be at pan 0.2 in the end.
inline Problem table_problem(double goal_pan = 0.2) {
  Problem problem;
  problem.name = "table";
  problem.robot = pr2_like_arm();
  problem.robot.posture = over_table(-0.6);
  problem.q_start = over_table(-0.6);
  problem.scene.objects = {fixture_box("table", {0.85, -0.3, 0.75}, {0.6, 1.4, 0.04}, Touch::support)};
  problem.task = ReachJoints{over_table(goal_pan), 0.0175};
  return problem;
}

/// Where the tool is at a pan angle, seen from above.
inline Eigen::Vector2d hand_at(double pan) {
  return Eigen::Vector2d(-0.05, -0.188) + 0.94 * Eigen::Vector2d(std::cos(pan), std::sin(pan));
}

/// A low light slippery can in the way of the hand at a pan angle: it slides and stays upright.
inline Object can_at(const std::string& id, double pan, ObjectKind kind = ObjectKind::movable, double length = 0.1,
                     double friction = 0.25) {
  const Eigen::Vector2d p = hand_at(pan);
  return standing_cylinder(id, p.x(), p.y(), 0.035, length, kind, 0.2, friction);
}

inline std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  for (int i = 0; i < robot.dof(); ++i) names.push_back(robot.joint(i).name);
  return names;
}

inline Segment motion(const Problem& problem, const std::vector<Eigen::VectorXd>& path,
                      SegmentKind kind = SegmentKind::reach) {
  Segment segment;
  segment.kind = kind;
  segment.joint_names = joint_names(problem.robot);
  segment.motion = time_path(problem.robot, path, problem.scene.physics.step);
  return segment;
}

/// One segment per pan angle, from the start.
inline Plan sweep(const Problem& problem, const std::vector<double>& pans) {
  Plan plan;
  Eigen::VectorXd q = problem.q_start;
  for (double pan : pans) {
    plan.segments.push_back(motion(problem, {q, over_table(pan)}));
    q = over_table(pan);
  }
  return plan;
}

}  // namespace mamo::fixtures
