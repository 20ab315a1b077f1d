// What a search needs to know of its domain. No word of robots here.
#pragma once

#include <atomic>
#include <concepts>
#include <cstdint>
#include <vector>

namespace mamo::search {

/// Integer costs: f has no rounding and ties are explicit. The domain's unit (the lattice: milliradians).
using Cost = std::int64_t;
inline constexpr Cost kUnreachable = INT64_MAX / 8;  // heuristic value of a state that cannot reach a goal

/// A lazy edge: its cost is known, its child is not born until the edge is evaluated.
struct LazyEdge {
  std::int32_t action = 0;  // with the parent state all that evaluate() needs
  Cost cost = 0;            // > 0
  Cost heuristic = 0;       // of the child; must not depend on what the evaluation finds out
};

/// What an evaluation says besides its child. A pure function of (state, action), but for the last line.
struct EdgeReport {
  bool valid = false;
  bool cancelled = false;   // stopped from outside: neither valid nor invalid, nothing else is meaningful
  std::int32_t tag = 0;     // the domain's own code (the lattice: cause of failure), tallied at commit
  std::int32_t charge = 0;  // uses of the counted resource (the lattice: simulations), limited by max_charge
  std::int64_t work = 0;    // summed at commit (the lattice: collision checks)
  float costly_us = 0;      // CPU time of the dear tier (the lattice: physics); for traces, not a function of the edge
};

template <class State>
struct EdgeOutcome : EdgeReport {
  State child{};  // if valid
};

/// D's methods are const and safe to call from several threads, each with its own Context. All but evaluate()
/// are cheap and inline; evaluate() may take milliseconds of physics and must be a pure function of
/// (state, action): the outcome may not depend on the context's past, on threads or on time.
///
/// A state has two keys: the exact one, identity, `a == b`; and its class, which decides
/// duplicates: a class closes when its first member commits. same_class is an equivalence coarser than ==.
///
/// `cancel` may be null. An evaluation that can last more than a few milliseconds polls it, and the query's
/// StopSource besides, and then returns `cancelled`: nobody watches the clock on behalf of a worker.
template <class D>
concept Domain = requires(const D d, typename D::Context context, const typename D::State s, std::int32_t action,
                          std::vector<LazyEdge> edges, const std::atomic<bool>* cancel) {
  { d.start() } -> std::convertible_to<typename D::State>;
  { s == s } -> std::convertible_to<bool>;
  { d.hash(s) } -> std::convertible_to<std::uint64_t>;
  { d.class_hash(s) } -> std::convertible_to<std::uint64_t>;
  { d.same_class(s, s) } -> std::convertible_to<bool>;
  { d.is_goal(s) } -> std::convertible_to<bool>;
  { d.heuristic(s) } -> std::convertible_to<Cost>;
  { d.successors(context, s, edges) };  // clears and fills `edges`, in a fixed order
  { d.evaluate(context, s, action, cancel) } -> std::same_as<EdgeOutcome<typename D::State>>;
};

/// Optional: d.known_child(s, action, child) is true when a valid evaluation of (s, action) can have no other
/// child than the one it writes. Cheap, pure. Edges into closed classes are then dropped unevaluated.
template <class D>
concept PredictsChild = requires(const D d, const typename D::State s, std::int32_t action, typename D::State child) {
  { d.known_child(s, action, child) } -> std::convertible_to<bool>;
};

/// Optional: d.on_commit(s, action, report) is called once for every evaluation that commits, in commit order,
/// one call at a time (on any thread), and returns the charge to count. A domain that memoises outcomes needs it:
/// what speculation left in the memo must not show in a counter.
template <class D>
concept ObservesCommits = requires(const D d, const typename D::State s, std::int32_t action, EdgeReport report) {
  { d.on_commit(s, action, report) } -> std::same_as<std::int32_t>;
};

}  // namespace mamo::search
