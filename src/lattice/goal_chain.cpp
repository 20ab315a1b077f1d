#include "mamo/lattice/goal_chain.hpp"

#include "mamo/lattice/joint_path.hpp"

namespace mamo {

std::vector<GoalChain> make_goal_chains(const Problem& problem, CollisionChecker& checker, const ObjectSet& walls,
                                        const std::vector<Eigen::VectorXd>& goals, std::uint64_t seed,
                                        const GoalChainOptions& options, StopSource* stop) {
  std::vector<GoalChain> chains;
  if (goals.empty()) return chains;
  checker.set_state(WorldState::start_of(problem.scene));
  const JointPathQuery query{problem.q_start, goals, walls, ObjectSet(problem.scene.size()), {}};
  for (int k = 0; k < options.chains; ++k) {
    RandomStream random(seed, {0x636861696e, static_cast<std::uint64_t>(k)});
    const std::vector<Eigen::VectorXd> path = find_joint_path(
        problem.robot, checker, query, random, {options.max_nodes, options.step, options.shortcuts, false}, stop);
    if (path.size() < 2) continue;
    GoalChain chain;
    chain.q = subdivided(path, options.spacing);
    while (goals[static_cast<std::size_t>(chain.goal)] != path.back()) ++chain.goal;
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace mamo
