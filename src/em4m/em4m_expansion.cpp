// ExpandState of Algorithm 1: paths for the objects, pushes along them; attempts computed ahead, committed in serial
// order.
#include "em4m/em4m_query.hpp"

namespace mamo {

bool Em4mQuery::grow_invalid_goals(Vertex& vertex) {
  if (!vertex.news) {
    if (vertex.valid_goals.empty()) return false;
    for (const auto& [object, goal] : vertex.valid_goals) vertex.invalid[object].emplace(goal, 1);
    vertex.valid_goals.clear();
  }
  vertex.news = false;
  return true;
}

ObjectPathsResult Em4mQuery::paths_of(const Vertex& vertex) {
  const Stopwatch watch;
  ObjectPathsResult found =
      path_finder().solve(vertex.state, regions_[static_cast<std::size_t>(vertex.region)], vertex.invalid, &stop());
  result().stats.mapf_s += watch.seconds();
  ++result().stats.mapf_calls;
  return found;
}

void Em4mQuery::expand(Vertex& vertex) {
  if (!grow_invalid_goals(vertex)) return close(vertex);
  ++result().stats.expansions;
  ++vertex.expansions;
  reorder(vertex);
  signature().add(content_hash(movables(), vertex.state));
  const ObjectPathsResult found = paths_of(vertex);
  if (found.stopped) return stopped();
  if (!found.solved) ++result().stats.failures[found.budget_used_up ? "mapf_budget" : "mapf_unsolvable"];
  if (found.solved && found.paths.empty()) ++result().stats.failures["mapf_moves_nobody"];
  // Paths that conflict are better than none: pushes are judged by physics, and other objects move only later.
  if (found.paths.empty()) return close(vertex);
  if (options().explain) notes_.paths(static_cast<int>(result().stats.expansions), found.paths, vertex.state);
  std::vector<const ObjectPath*> paths;
  for (const ObjectPath& path : found.paths)
    if (!push_again(vertex, path)) paths.push_back(&path);
  std::vector<Attempts> attempts = post_attempts(vertex, paths);
  for (std::size_t p = 0; p < paths.size() && !over(); ++p) {
    const ObjectPath& path = *paths[p];
    if (push_object(vertex, path, attempts[p])) {
      vertex.valid_goals.push_back({path.object, path.goal});
    } else {
      vertex.invalid[path.object][path.goal] += settings_.rearrangement.attempts;
      vertex.news = true;
    }
  }
  for (Attempts& of_object : attempts)
    for (Attempt& attempt : of_object) board().drop(attempt.job);
}

bool Em4mQuery::push_again(Vertex& vertex, const ObjectPath& path) {
  if (!variant_.positive_cache) return false;
  auto stored = database_.find(path, vertex.state, movables(), worker());
  if (!stored) return false;
  ++result().stats.cache_hits;
  WorldState after = PushDatabase::after(*stored, vertex.state);
  add_successor(vertex, path, std::move(stored), std::move(after));
  vertex.valid_goals.push_back({path.object, path.goal});
  return true;
}

std::vector<Em4mQuery::Attempts> Em4mQuery::post_attempts(const Vertex& vertex,
                                                          const std::vector<const ObjectPath*>& paths) {
  std::vector<Attempts> attempts(paths.size());
  const std::uint64_t content = content_hash(movables(), vertex.state);
  for (std::size_t p = 0; p < paths.size(); ++p) {
    HashStream stream;
    stream.add(content);
    stream.add(paths[p]->object.value);
    stream.add(paths[p]->goal.x);
    stream.add(paths[p]->goal.y);
    for (int k = 0; k < settings_.rearrangement.attempts; ++k) {
      Attempt& attempt = attempts[p].emplace_back();
      attempt.outcome = std::make_shared<PushOutcome>();
      PushRequest request{paths[p]->object, paths[p]->points, vertex.state, k, stream.value()};
      // All first attempts before all second ones: every object's first one is needed for certain.
      attempt.job = board().post(k, [this, out = attempt.outcome, request = std::move(request)](
                                        WorkerId w, const std::atomic<bool>& cancelled) {
        *out = worker(w).attempt(request, &stop(), &cancelled);
      });
    }
  }
  return attempts;
}

bool Em4mQuery::push_object(Vertex& vertex, const ObjectPath& path, Attempts& attempts) {
  for (std::size_t k = 0; k < attempts.size(); ++k) {
    board().finish(attempts[k].job);
    const std::shared_ptr<const PushOutcome> outcome = attempts[k].outcome;
    if (!count(path.object, *outcome)) return false;
    if (!outcome->valid()) {
      if (options().explain) notes_.failed(static_cast<int>(result().stats.expansions), path, *outcome, vertex.state);
      continue;
    }
    for (std::size_t rest = k + 1; rest < attempts.size(); ++rest) board().drop(attempts[rest].job);
    if (variant_.positive_cache) database_.store(path, vertex.state, outcome);
    add_successor(vertex, path, outcome, outcome->after);
    return true;
  }
  return false;
}

}  // namespace mamo
