// A reach problem in code: the PR2-like arm before the cluttered shelf, goal inside it.
#pragma once

#include "support/fixtures.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/lattice/manipulation_lattice.hpp"

namespace mamo::fixtures {

inline Problem reach_problem(int movables, int immovables, std::uint64_t seed) {
  Problem problem;
  problem.name = problem.path = "reach_problem";
  problem.robot = pr2_like_arm();
  problem.scene = cluttered_shelf(movables, immovables, seed);
  problem.q_start = problem.robot.posture;
  ReachPose task;
  RandomStream random(seed, {0x676f616c});
  task.X_WT =
      at(random.uniform(0.6, 0.8), random.uniform(-0.7, -0.3), random.uniform(0.85, 0.95), random.uniform(-0.6, 0.6));
  problem.task = task;
  return problem;
}

/// Everything below a planner for one problem, as a planner would build it.
struct LatticeKit {
  explicit LatticeKit(const Problem& p, const LatticeOptions& options = {})
      : problem(p),
        kinematics(std::make_shared<ForwardKinematics>(p.robot)),
        evaluator(p, kinematics, options.collision),
        all(make_relevant_bodies(p, ObjectSet::all(p.scene))) {
    ObjectSet walls(p.scene.size());
    for (ObjectId id : all.forbidden.ids())
      if (!p.scene[id].movable()) walls.insert(id);
    const TrackedPoint point = tracked_point(*kinematics);
    ReachGoal goal =
        make_reach_goal(p, *kinematics, point, evaluator.collision(), walls, 1, options.goal_configurations);
    GoalChains chains =
        make_goal_chains(p, evaluator.collision(), walls, goal.configurations, 1, options.chains, nullptr);
    model =
        std::make_unique<LatticeModel>(p, kinematics, options, std::move(goal), std::move(chains.chains), point, walls);
  }
  RelevantBodies only(std::initializer_list<int> ids) const {
    ObjectSet set = ObjectSet::of_kind(problem.scene, ObjectKind::immovable);
    for (int id : ids) set.insert(ObjectId(id));
    return make_relevant_bodies(problem, set);
  }
  const Problem& problem;
  std::shared_ptr<const ForwardKinematics> kinematics;
  EdgeEvaluator evaluator;
  RelevantBodies all;
  std::unique_ptr<LatticeModel> model;
};

}  // namespace mamo::fixtures
