// What both weighted A* searches keep of their commits: the tree, the counters, the hash, the limits, the result.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mamo/common/hash.hpp"
#include "mamo/search/open_list.hpp"
#include "mamo/search/search_result.hpp"
#include "mamo/search/state_table.hpp"

namespace mamo::search {

/// An evaluated edge as the serial order sees it: the report, and the child's id if valid.
struct Outcome {
  EdgeReport report;
  StateId child = kNoState;
};

/// The edge whose outcome the serial order asks for next.
struct Need {
  StateId parent;
  std::int32_t edge = 0;  // index among the parent's successors; kSuccessors: they themselves are needed
  std::int32_t action = 0;
  static constexpr std::int32_t kSuccessors = -1;
};

/// What a commit did to OPEN.
struct Committed {
  StateId closed = kNoState;  // lazy: its edges are in OPEN now
  StateId opened = kNoState;  // eager: it is in OPEN now
  Cost g = 0;                 // of that state
};

/// What an order asks of whoever drives it:
///   successors(state)  the edges of a state, or nothing if they are still to be generated (a lazy order's driver
///                      always has them; an eager order then needs {state, kSuccessors});
///   known_child(need)  the only child the edge can have, if the domain predicts one (PredictsChild), else kNoState;
///   dropped(need)      told when an edge leaves the order without an evaluation.
template <class H>
concept OrderHost = requires(H host, StateId state, const Need& need) {
  { host.successors(state) } -> std::same_as<std::optional<std::span<const LazyEdge>>>;
  { host.known_child(need) } -> std::same_as<StateId>;
  { host.dropped(need) };
};

template <Domain D, class Table>
class CommitLog {
 public:
  using State = typename D::State;
  struct Node {
    StateId state;
    std::int32_t parent = -1;  // node
    std::int32_t action = 0;
    Cost g = 0;
  };
  enum class Verdict : std::uint64_t { known_duplicate, invalid, duplicate, accepted };

  CommitLog(const D& domain, Table& table, const SearchOptions& options)
      : domain_(domain), table_(table), options_(options) {}

  std::int32_t add_node(const Node& node) {
    nodes_.push_back(node);
    return static_cast<std::int32_t>(nodes_.size() - 1);
  }
  const Node& node(std::int32_t index) const { return nodes_[static_cast<std::size_t>(index)]; }
  SearchCounters& counters() { return counters_; }
  const SearchCounters& counters() const { return counters_; }

  /// Books an evaluation that the search consumed.
  void book(StateId parent, std::int32_t action, const Outcome& outcome) {
    const EdgeReport& report = outcome.report;
    ++counters_.evaluations;
    ++(report.valid ? counters_.valid : counters_.invalid);
    if (report.tag != 0) ++counters_.tags[report.tag];
    counters_.work += report.work;
    if constexpr (ObservesCommits<D>) {
      counters_.charge += domain_.on_commit(table_.state(parent), action, report);
    } else {
      counters_.charge += report.charge;
    }
  }
  /// Adds a decision to the order hash: contents only, never ids.
  void record(StateId parent, std::int32_t action, Cost g, Verdict verdict, StateId child = kNoState) {
    hash_.add(table_.hash(parent));
    hash_.add(action);
    hash_.add(g);
    hash_.add(static_cast<std::uint64_t>(verdict));
    if (child != kNoState) hash_.add(table_.hash(child));
  }
  /// Counts a dropped duplicate whose exact key is not the one that closed the class.
  void count_merge(bool exact_differs) { counters_.merged += exact_differs; }

  std::optional<EndReason> expansion_limit() const {
    if (counters_.expansions >= options_.max_expansions) return EndReason::limit_expansions;
    return std::nullopt;
  }
  std::optional<EndReason> evaluation_limit() const {
    if (counters_.evaluations >= options_.max_evaluations) return EndReason::limit_evaluations;
    if (counters_.charge >= options_.max_charge) return EndReason::limit_charge;
    return std::nullopt;
  }
  SearchProgress progress(const OpenList& open) const {
    return {counters_.expansions, counters_.evaluations, counters_.charge, min_f(open)};
  }

  /// `goal` is the goal's node, or -1.
  SearchResult<State> result(EndReason reason, std::int32_t goal, const OpenList& open) const {
    SearchResult<State> result;
    result.reason = reason;
    result.open_min_f = min_f(open);
    result.counters = counters_;
    result.merged = counters_.merged > 0;
    result.order_hash = hash_.value();
    if (goal < 0) return result;
    result.last = table_.state(node(goal).state);
    result.cost = node(goal).g;
    result.bound = Weight(options_.weight).value();
    for (std::int32_t n = goal; node(n).parent >= 0; n = node(n).parent) {
      const Node& parent = node(node(n).parent);
      result.path.push_back(
          {table_.state(parent.state), node(n).action, table_.state(node(n).state), node(n).g - parent.g});
    }
    std::reverse(result.path.begin(), result.path.end());
    return result;
  }

 private:
  static double min_f(const OpenList& open) {
    return open.empty() ? std::numeric_limits<double>::infinity() : static_cast<double>(open.top().f) / 1000.0;
  }

  const D& domain_;
  Table& table_;
  const SearchOptions& options_;
  std::vector<Node> nodes_;
  SearchCounters counters_;
  HashStream hash_;
};

}  // namespace mamo::search
