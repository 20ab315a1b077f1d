// Options and results that every search of this module shares.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/search/domain.hpp"

namespace mamo::search {

/// For a progress line.
struct SearchProgress {
  std::int64_t expansions = 0, evaluations = 0, charge = 0;
  double open_min_f = 0;  // smallest g + W h of OPEN, in units of cost
};

inline constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

/// Limits count committed work only, so they cut every run at the same place; `stop` is the only clock.
struct SearchOptions {
  double weight = 1;  // suboptimality factor W >= 1, used to three decimals
  std::int64_t max_expansions = kNoLimit;  // a goal may still close when they are used up
  std::int64_t max_evaluations = kNoLimit;
  std::int64_t max_charge = kNoLimit;  // of EdgeReport::charge; the evaluation that reaches it still counts
  StopSource* stop = nullptr;          // may be null
  std::function<void(const SearchProgress&)> on_progress;  // now and then, on the caller's thread; may be empty
};

enum class EndReason { goal, exhausted, limit_expansions, limit_evaluations, limit_charge, stopped };
std::string_view to_string(EndReason reason);

/// What the committed search did: equal for every number of threads and every schedule.
struct SearchCounters {
  std::int64_t expansions = 0;       // classes closed whose successors were generated
  std::int64_t generated = 0;        // edges pushed (eager: states pushed)
  std::int64_t evaluations = 0;      // = valid + invalid
  std::int64_t valid = 0, invalid = 0;
  std::int64_t duplicates = 0;       // valid, but the child's class was closed (eager: or reached as cheaply)
  std::int64_t known_duplicates = 0; // dropped unevaluated: the known child was closed (eager: or reached) before
  std::int64_t merged = 0;           // dropped duplicates whose exact key differed from the one that closed
  std::int64_t pruned_infinite = 0;  // edges dropped for their kUnreachable heuristic
  std::int64_t charge = 0, work = 0;
  std::map<std::int32_t, std::int64_t> tags;  // EdgeReport::tag -> evaluations

  friend bool operator==(const SearchCounters&, const SearchCounters&) = default;
};

template <class State>
struct PathStep {
  State parent;
  std::int32_t action = 0;
  State child;
  Cost cost = 0;  // of this edge
};

template <class State>
struct SearchResult {
  EndReason reason = EndReason::exhausted;
  std::vector<PathStep<State>> path;  // from the start to the goal; empty if none, or if the start is a goal
  State last{};                       // the goal state, if found
  Cost cost = 0;                      // of the path
  /// With a consistent heuristic cost <= bound x the cheapest path; when `merged` the cheapest path of the lattice
  /// in which every class is the state that closed it. 0 without a path.
  double bound = 0;
  bool merged = false;
  double open_min_f = 0;  // smallest g + W h left in OPEN (infinity if none); / W bounds any path from below
  SearchCounters counters;
  std::uint64_t order_hash = 0;  // of everything committed, in order

  bool found() const { return reason == EndReason::goal; }
};

}  // namespace mamo::search
