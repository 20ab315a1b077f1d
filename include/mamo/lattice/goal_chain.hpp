// Ways to the goal among what stays: a few seeded RRT-Connect paths (Kuffner, LaValle 2000) from the start to the
// goal configurations, kept as chains of configurations that lattice states may join.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// q.front() is the start, q.back() the goal configuration with index `goal`.
struct GoalChain {
  std::vector<Eigen::VectorXd> q;
  int goal = 0;
};

struct GoalChainOptions {
  int chains = 3;        // each from a random stream of its own
  int max_nodes = 4000;  // per chain, both trees together; a chain that is not found by then is left out
  double step = 0.25;    // rad or m (Euclidean) of one tree edge
  double spacing = 0.5;  // between neighbours of a finished chain
  int shortcuts = 60;    // attempts to shorten a chain
};

struct GoalChains {
  std::vector<GoalChain> chains;
  bool budget_used_up = false;  // some chain was not found within max_nodes (or before the stop)
};

/// Depends on the robot, the bodies in `walls` (at their start poses), start, goals and seed only: movable objects
/// are no obstacle. Empty without goals. `checker` is left with the scene's start state.
GoalChains make_goal_chains(const Problem& problem, CollisionChecker& checker, const ObjectSet& walls,
                            const std::vector<Eigen::VectorXd>& goals, std::uint64_t seed,
                            const GoalChainOptions& options, StopSource* stop);

}  // namespace mamo
