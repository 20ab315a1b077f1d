#include "lattice_search.hpp"

#include "mamo/io/load.hpp"

namespace mamo {

Result<std::unique_ptr<LatticeSearch>> LatticeSearch::load(const std::string& problem_file) {
  auto problem = io::load_problem(problem_file);
  if (!problem.ok()) return problem.error();
  choose_self_pairs(problem->robot, problem->robot_files.disabled, !problem->robot_files.srdf.empty(), 1);
  return std::unique_ptr<LatticeSearch>(new LatticeSearch(*std::move(problem)));
}

LatticeSearch::LatticeSearch(Problem problem) : problem_(std::move(problem)) {
  constexpr std::uint64_t kSeed = 1;  // the tool's default
  const LatticeOptions options;
  kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
  evaluator_ = std::make_unique<EdgeEvaluator>(problem_, kinematics_, options.collision);
  const RelevantBodies bodies = make_relevant_bodies(problem_, ObjectSet::all(problem_.scene));
  ObjectSet walls(problem_.scene.size());
  for (const ObjectId id : bodies.forbidden.ids()) {
    if (!problem_.scene[id].movable()) walls.insert(id);
  }
  const TrackedPoint point = tracked_point(*kinematics_);
  ReachGoal goal = make_reach_goal(problem_, *kinematics_, point, evaluator_->collision(), walls, kSeed,
                                   options.goal_configurations);
  GoalChains chains =
      make_goal_chains(problem_, evaluator_->collision(), walls, goal.configurations, kSeed, options.chains, nullptr);
  model_ = std::make_unique<LatticeModel>(problem_, kinematics_, options, std::move(goal), std::move(chains.chains),
                                          point, walls);
  lattice_ = std::make_unique<ManipulationLattice>(problem_, *model_, bodies, banned_, nullptr);
}

}  // namespace mamo
