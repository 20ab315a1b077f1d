#include "mamo/lattice/goal_chain.hpp"

#include "mamo/lattice/joint_path.hpp"

namespace mamo {

GoalChains make_goal_chains(const Problem& problem, CollisionChecker& checker, const ObjectSet& walls,
                            const std::vector<Eigen::VectorXd>& goals, std::uint64_t seed,
                            const GoalChainOptions& options, StopSource* stop) {
  GoalChains out;
  if (goals.empty()) return out;
  checker.set_state(WorldState::start_of(problem.scene));
  const JointPathQuery query{problem.q_start, goals, walls, ObjectSet(problem.scene.size()), {}};
  for (int k = 0; k < options.chains; ++k) {
    RandomStream random(seed, {0x636861696e, static_cast<std::uint64_t>(k)});
    const std::vector<Eigen::VectorXd> path = find_joint_path(
        problem.robot, checker, query, random, {options.max_nodes, options.step, options.shortcuts, false}, stop);
    out.budget_used_up = out.budget_used_up || path.empty();
    if (path.size() < 2) continue;
    GoalChain chain;
    chain.q = subdivided(path, options.spacing);
    while (goals[static_cast<std::size_t>(chain.goal)] != path.back()) ++chain.goal;
    out.chains.push_back(std::move(chain));
  }
  return out;
}

}  // namespace mamo
