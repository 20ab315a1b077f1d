#include "mamo/push/push_planner.hpp"

#include <algorithm>

#include "push/push_attempt.hpp"

namespace mamo {

using push::PushAttempt;
using push::PushTools;

struct PushPlanner::Impl {
  PushTools tools;

  bool clear_of(const std::vector<Eigen::VectorXd>& path, const ObjectSet& others) {
    const ObjectSet nothing(tools.problem.scene.size());
    for (std::size_t k = 1; k < path.size(); ++k)
      if (!tools.checker.check_edge(path[k - 1], path[k], nothing, others, tools.report) ||
          !tools.report.touched.empty())
        return false;
    return true;
  }
};

PushPlanner::PushPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                         const PushOptions& options, std::uint64_t seed)
    : impl_(new Impl{{problem, std::move(kinematics), options, seed}}) {}
PushPlanner::~PushPlanner() = default;

PushOutcome PushPlanner::attempt(const PushRequest& request, StopSource* stop, const std::atomic<bool>* cancel) {
  PushTools& tools = impl_->tools;
  const std::int64_t checks = tools.checker.checks();
  const double simulated = tools.evaluator.simulation_s();
  PushOutcome out = PushAttempt(tools, request, stop, cancel).run();
  out.collision_checks = tools.checker.checks() - checks;
  out.simulation_s = tools.evaluator.simulation_s() - simulated;
  return out;
}

bool PushPlanner::reusable(const PushOutcome& stored, const WorldState& state, const ObjectSet& others) {
  CollisionChecker& checker = impl_->tools.checker;
  checker.set_state(state);
  for (const auto* path : {&stored.push, &stored.approach})
    if (!impl_->clear_of(*path, others)) return false;
  WorldState after = state;
  for (const ObjectId id : stored.moved) after[id] = stored.after[id];
  checker.set_state(after);
  if (!impl_->clear_of(stored.retreat, others)) return false;
  const auto moved = [&](ObjectId id) {
    return std::find(stored.moved.begin(), stored.moved.end(), id) != stored.moved.end();
  };
  const auto pairs = checker.overlapping_objects(0);
  return std::none_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return (moved(pair.first) && others.contains(pair.second)) || (moved(pair.second) && others.contains(pair.first));
  });
}

CollisionChecker& PushPlanner::collision() { return impl_->tools.checker; }
std::int64_t PushPlanner::simulations() const { return impl_->tools.evaluator.simulations(); }
double PushPlanner::simulation_s() const { return impl_->tools.evaluator.simulation_s(); }

}  // namespace mamo
