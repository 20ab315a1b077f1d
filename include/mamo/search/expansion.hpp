// The outgoing edges of a state with what is known of each: the edge cells beside the closed list.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "mamo/search/commit_log.hpp"

namespace mamo::search {

/// The life of an evaluation. All of it is read and written under the scheduler's lock.
enum class CellPhase : std::uint8_t {
  fresh,    // nobody has begun; a cancelled evaluation returns here
  running,  // some worker evaluates it
  done,     // the outcome waits for its turn
  gone      // committed, or it can never be needed
};

struct Cell {
  CellPhase phase = CellPhase::fresh;
  bool failed = false;           // done: the evaluation threw; the exception is raised if its turn comes
  bool valid = false;            // done
  std::int32_t slot = -1;        // running: of the worker
  std::int32_t round = -1;       // of schedule `batch`
  std::int32_t evaluation = -1;  // running or done: the scheduler's record of it
  StateId known = kNoState;      // the only child it can have, if the domain predicts one
  StateId child = kNoState;      // done and valid
};

struct Expansion {
  std::vector<LazyEdge> edges;
  std::vector<std::int32_t> order;  // edges worth evaluating, best first
  std::vector<Cell> cells;          // beside edges
};

/// Generates the successors of a state: dear enough (heuristics of all children) to be done by workers, unlocked.
/// scratch: a worker's own, so that the vectors that stay are allocated once, in their final size.
template <Domain D>
std::unique_ptr<Expansion> expand(const D& domain, typename D::Context& context, StateTable<D>& table,
                                  typename StateTable<D>::Writer& writer, std::vector<LazyEdge>& scratch, StateId state,
                                  const Weight& weight, bool by_f) {
  domain.successors(context, table.state(state), scratch);
  auto expansion = std::make_unique<Expansion>();
  const std::vector<LazyEdge>& edges = expansion->edges = scratch;
  expansion->cells.resize(edges.size());
  expansion->order.reserve(edges.size());
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(edges.size()); ++i) {
    const LazyEdge& edge = edges[static_cast<std::size_t>(i)];
    if (edge.heuristic >= kUnreachable) continue;
    expansion->order.push_back(i);
    if constexpr (PredictsChild<D>) {
      typename D::State child{};
      if (domain.known_child(table.state(state), edge.action, child)) {
        expansion->cells[static_cast<std::size_t>(i)].known = table.intern(child, writer);
      }
    }
  }
  if (!by_f) return expansion;
  std::sort(expansion->order.begin(), expansion->order.end(), [&](std::int32_t a, std::int32_t b) {
    const LazyEdge &x = edges[static_cast<std::size_t>(a)], &y = edges[static_cast<std::size_t>(b)];
    const Cost fx = weight.f(x.cost, x.heuristic), fy = weight.f(y.cost, y.heuristic);
    if (fx != fy) return fx < fy;
    return x.cost != y.cost ? x.cost > y.cost : a < b;
  });
  return expansion;
}

}  // namespace mamo::search
