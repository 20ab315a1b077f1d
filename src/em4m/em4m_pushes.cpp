// The pushes of one expansion: attempts computed ahead, committed in serial order.
#include "em4m/em4m_query.hpp"

namespace mamo {

std::vector<std::vector<Em4mQuery::Attempt>> Em4mQuery::post_attempts(const Vertex& vertex,
                                                                      const std::vector<ObjectPath>& paths) {
  std::vector<std::vector<Attempt>> attempts(paths.size());
  const std::uint64_t content = content_hash(movables_, vertex.state);
  for (std::size_t p = 0; p < paths.size(); ++p) {
    HashStream stream;
    stream.add(content);
    stream.add(paths[p].object.value);
    stream.add(paths[p].goal.x);
    stream.add(paths[p].goal.y);
    for (int k = 0; k < settings_.attempts; ++k) {
      Attempt& attempt = attempts[p].emplace_back();
      attempt.outcome = std::make_shared<PushOutcome>();
      PushRequest request{paths[p].object, paths[p].points, vertex.state, k, stream.value()};
      // All first attempts before all second ones: most objects need few, and they are asked for object by object.
      attempt.job = board_.post(k, [this, out = attempt.outcome, request = std::move(request)](
                                       WorkerId w, const std::atomic<bool>& cancelled) {
        *out = workers_[w.index()]->attempt(request, context_.stop, &cancelled);
      });
    }
  }
  return attempts;
}

bool Em4mQuery::counted(const ObjectPath& path, const PushOutcome& outcome) {
  PlanStats& stats = result_.stats;
  if (outcome.failure == PushFailure::stopped) return stopped(), false;
  if (stats.simulations_used + outcome.simulations > options_.max_simulations) {
    finish(PlanStatus::limit, "no plan within the limit on simulations; --max-simulations raises it");
    return false;
  }
  ++stats.push_attempts;
  stats.simulations_used += outcome.simulations;
  stats.collision_checks += outcome.collision_checks;
  signature_.add(static_cast<std::int32_t>(outcome.failure));
  if (outcome.valid()) return true;
  std::string cause(to_string(outcome.failure));
  if (outcome.violation) cause = "simulation_" + std::string(to_string(outcome.violation->kind));
  ++stats.failures["push_" + cause];
  ++causes_[path.object][cause];
  return true;
}

bool Em4mQuery::push_object(Vertex& vertex, const ObjectPath& path, std::vector<Attempt>& attempts) {
  if (variant_.positive_cache) {
    if (auto stored = database_.find(path, vertex.state, movables_, *workers_.front())) {
      ++result_.stats.cache_hits;
      WorldState after = PushDatabase::after(*stored, vertex.state);
      add_successor(vertex, path, std::move(stored), std::move(after));
      for (Attempt& attempt : attempts) board_.drop(attempt.job);
      return true;
    }
  }
  for (std::size_t k = 0; k < attempts.size(); ++k) {
    board_.finish(attempts[k].job);
    const std::shared_ptr<const PushOutcome> outcome = attempts[k].outcome;
    if (!counted(path, *outcome)) return false;
    if (!outcome->valid()) continue;
    for (std::size_t rest = k + 1; rest < attempts.size(); ++rest) board_.drop(attempts[rest].job);
    if (variant_.positive_cache) database_.store(path, vertex.state, outcome);
    add_successor(vertex, path, outcome, outcome->after);
    return true;
  }
  return false;
}

}  // namespace mamo
