// Slow, obvious searches that the fast ones are compared with. They share no code with src or include.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <vector>

#include "mamo/search/toy_domain.hpp"

namespace mamo::search::reference {

using Key = std::pair<std::int32_t, std::int32_t>;  // node, label
inline Key key(const ToyState& s) { return {s.node, s.label}; }

/// Cost of the cheapest path over valid edges between exact states, or nothing.
template <class D>
std::optional<Cost> dijkstra(const D& domain) {
  typename D::Context context{};
  std::map<Key, Cost> best{{key(domain.start()), 0}};
  std::set<std::pair<Cost, Key>> queue{{0, key(domain.start())}};
  std::vector<LazyEdge> edges;
  while (!queue.empty()) {
    const auto [g, k] = *queue.begin();
    queue.erase(queue.begin());
    const ToyState s{k.first, k.second};
    if (domain.is_goal(s)) return g;
    domain.successors(context, s, edges);
    for (const LazyEdge& e : edges) {
      const auto outcome = domain.evaluate(context, s, e.action, nullptr);
      if (!outcome.valid) continue;
      const auto [it, fresh] = best.insert({key(outcome.child), g + e.cost});
      if (!fresh && it->second <= g + e.cost) continue;
      if (!fresh) queue.erase({it->second, it->first});
      it->second = g + e.cost;
      queue.insert({it->second, it->first});
    }
  }
  return std::nullopt;
}

/// One committed evaluation.
struct Event {
  Key parent;
  std::int32_t action;
  Cost g;
  bool valid, closed_now;
  Key child;
  friend bool operator==(const Event&, const Event&) = default;
};

struct LazyRun {
  std::vector<Event> events;
  bool found = false;
  Cost cost = 0;
  bool merged = false;
};

/// Lazy weighted A* straight from the text of ALGORITHMS.md, weight in thousandths. Ignores known children.
inline LazyRun lazy_weighted_astar(const RandomGraph& domain, std::int64_t milli) {
  using Class = std::pair<std::int32_t, std::int32_t>;
  const auto class_of = [&](const ToyState& s) { return Class{s.node, s.label / domain.options().class_size}; };
  struct Edge {
    std::int64_t f, g, seq;
    ToyState parent;
    std::int32_t action;
    bool operator<(const Edge& o) const { return std::tie(f, o.g, seq) < std::tie(o.f, g, o.seq); }
  };
  LazyRun run;
  std::set<Edge> open;
  std::map<Class, ToyState> closed;
  std::int64_t seq = 0;
  const auto close = [&](const ToyState& s, Cost g) {
    closed[class_of(s)] = s;
    if (domain.is_goal(s)) return run.found = true, run.cost = g, true;
    RandomGraph::Context context;
    std::vector<LazyEdge> edges;
    domain.successors(context, s, edges);
    for (const LazyEdge& e : edges) {
      if (e.heuristic >= kUnreachable) continue;
      open.insert({1000 * (g + e.cost) + milli * e.heuristic, g + e.cost, seq++, s, e.action});
    }
    return false;
  };
  if (close(domain.start(), 0)) return run;
  while (!open.empty()) {
    const Edge e = *open.begin();
    open.erase(open.begin());
    const auto outcome = domain.outcome(e.parent, e.action);
    const bool fresh = outcome.valid && !closed.count(class_of(outcome.child));
    if (outcome.valid && !fresh && !(closed[class_of(outcome.child)] == outcome.child)) run.merged = true;
    run.events.push_back({key(e.parent), e.action, e.g, outcome.valid, fresh, key(outcome.child)});
    if (fresh && close(outcome.child, e.g)) break;
  }
  return run;
}

}  // namespace mamo::search::reference
