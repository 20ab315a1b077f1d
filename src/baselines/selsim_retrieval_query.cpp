#include "baselines/selsim_retrieval_query.hpp"

#include <algorithm>

namespace mamo {

void SelSimRetrievalQuery::search() {
  std::vector<bool> done(ways().size(), false);
  std::int64_t expansions = settings_.way_expansions;
  for (int round = 0; round < settings_.rounds; ++round, expansions *= 2) {
    for (std::size_t k = 0; k < ways().size(); ++k) {
      if (!done[k]) done[k] = tried(ways()[k], expansions);
      if (over()) return;
    }
    if (std::ranges::find(done, false) == done.end())
      return finish(PlanStatus::limit, "no grasp was reached from which the object could be fetched, by any of " +
                                           std::to_string(done.size()) +
                                           " ways, which proves nothing; ways raises that");
  }
  finish(PlanStatus::limit, "no plan within the expansions for each grasp; way_expansions and rounds raise them");
}

PlanResult SelSimRetrievalQuery::reach(const RetrievalPath& way, std::int64_t expansions) {
  constexpr double kTolerance = 1e-3;  // rad: the snap is exact
  Problem problem = reach_problem();
  problem.task = ReachJoints{way.reach.front(), kTolerance};
  PlanOptions reaching = options();
  reaching.set = set_;
  reaching.max_expansions = std::min(expansions, options().max_expansions - result().stats.expansions);
  reaching.max_simulations = options().max_simulations - result().stats.simulations_used;
  PlanContext context = context_;
  context.judge = nullptr;  // the whole plan is judged
  return make_selsim_planner(variant_)->plan(problem, reaching, context);
}

void SelSimRetrievalQuery::take_over(const PlanResult& reached) {
  PlanStats& stats = result().stats;
  const PlanStats& more = reached.stats;
  stats.expansions += more.expansions;
  stats.simulations += more.simulations;
  stats.simulations_used += more.simulations_used;
  stats.simulation_s += more.simulation_s;
  stats.tracking_simulations += more.tracking_simulations;
  stats.tracking_s += more.tracking_s;
  stats.collision_checks += more.collision_checks;
  stats.planning_iterations += more.planning_iterations;
  for (const auto& [cause, number] : more.failures) stats.failures[cause] += number;
  for (ObjectId id : more.relevant_objects)
    if (std::ranges::find(stats.relevant_objects, id) == stats.relevant_objects.end())
      stats.relevant_objects.push_back(id);
  signature().add(reached.signature);
}

bool SelSimRetrievalQuery::tried(const RetrievalPath& way, std::int64_t expansions) {
  if (result().stats.expansions >= options().max_expansions)
    return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it"), true;
  if (stop().stopped()) return stopped(), true;
  const PlanResult reached = reach(way, expansions);
  take_over(reached);
  if (out_of_simulations()) return true;
  switch (reached.status) {
    case PlanStatus::timeout:
    case PlanStatus::interrupted:
    case PlanStatus::memory:
      return stopped(), true;
    case PlanStatus::solved:
      break;
    case PlanStatus::limit:
      if (result().stats.simulations_used >= options().max_simulations)
        return finish(PlanStatus::limit, reached.reason), true;
      return reached.stats.expansions < expansions;  // it ended for another reason: more would not help
    default:
      return true;
  }
  std::vector<Eigen::VectorXd> path;
  for (const Eigen::VectorXd& q : reached.plan.segments.front().motion.q)
    if (path.empty() || path.back() != q) path.push_back(q);
  submit(std::move(path), way);
  return true;
}

}  // namespace mamo
