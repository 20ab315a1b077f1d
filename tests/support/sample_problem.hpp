// A small problem and a plan for it, built in code: what file formats are tried on.
#pragma once

#include <numbers>

#include "support/fixtures.hpp"

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::fixtures {

/// The PR2-like arm before a shelf with clutter; reach a pose.
inline Problem sample_problem(int movables = 3, int immovables = 1) {
  Problem problem;
  problem.name = "sample.yaml";
  problem.path = "sample.yaml";
  problem.robot = pr2_like_arm();
  problem.scene = cluttered_shelf(movables, immovables, 1);
  problem.q_start = problem.robot.posture;
  problem.task = ReachPose{at(0.7, -0.4, 0.9, 0.3)};
  return problem;
}

/// A reach and a push of two points each; the second starts where the first ends. The numbers are awkward.
inline Plan sample_plan(const Problem& problem) {
  std::vector<std::string> names;
  for (int i = 0; i < problem.robot.dof(); ++i) names.push_back(problem.robot.joint(i).name);
  const ObjectId pushed = ObjectSet::of_kind(problem.scene, ObjectKind::movable).ids().front();
  Eigen::VectorXd a = problem.q_start, b = a, c = a;
  b[0] += 0.1;
  c[0] += 1.0 / 3.0;
  Plan plan;
  Segment reach;
  reach.kind = SegmentKind::approach;
  reach.joint_names = names;
  reach.motion.t = {0, 0.5, 0.1 + 0.7};
  reach.motion.q = {a, (a + b) / 2, b};
  Segment push = reach;
  push.kind = SegmentKind::push;
  push.object = pushed;
  push.motion.t = {0, 1.0 / 3.0};
  push.motion.q = {b, c};
  for (ObjectId id : ObjectSet::all(problem.scene).ids()) {
    reach.objects_after[id] = problem.scene[id].X_WO;
    push.objects_after[id] = problem.scene[id].X_WO;
  }
  push.objects_after[pushed].translation().x() += 0.1 / 3;
  plan.segments = {reach, push};
  return plan;
}

}  // namespace mamo::fixtures
