// The serial order of lazy weighted A*, without the evaluations: it says which edge it needs next.
#pragma once

#include "mamo/search/commit_log.hpp"

namespace mamo::search {

/// Lazy weighted A* (Cohen, Phillips, Likhachev: "Planning Single-arm Manipulations with n-Arm Robots", SoCS 2015;
/// SelSim section IV-D), as a machine that a driver feeds with outcomes:
///
///     begin(start);  while (const Need* need = next()) commit(<outcome of need>);  result()
///
/// OPEN holds edges whose child is not born yet: the parent is closed, f = g(parent) + c + W h. One step:
///   1. pop the edge of least (f, then larger g, then earlier push);
///   2. a known child (PredictsChild) in a closed class: drop;
///   3. ask for the outcome; invalid: drop this edge only; the child's class closed: drop;
///   4. close the child's class with it; a goal: end; else push its edges, those with kUnreachable left out.
/// Nothing is reopened. With a consistent heuristic and no merged classes cost <= W x optimum, as for weighted A*
/// without reopening: an edge in OPEN stands for the child it may have, and the edge of a cheapest path that leaves
/// the closed set is always in OPEN.
///
/// Invariants at the head of every step: every edge of OPEN hangs on a closed state; a class is closed by exactly
/// one state; g never changes once given; the sequence of needs is a function of the outcomes committed so far.
/// Hence whoever feeds it, from however many threads, gets the serial search, if outcomes are pure.
///
/// A domain that fails to be pure voids all of this, and nothing here would notice; tests of the domain must.
template <class D, class Table>
class LazyOrder {
 public:
  static_assert(Domain<D>);
  using Log = CommitLog<D, Table>;
  using State = typename D::State;

  LazyOrder(const D& domain, Table& table, const SearchOptions& options)
      : domain_(domain), table_(table), options_(options), weight_(options.weight), log_(domain, table, options) {}

  template <OrderHost Host>
  void begin(StateId start, Host& host) {
    close({start, -1, 0, 0}, weight_.f(0, 0), host);
  }

  /// The edge at the head of OPEN, or null when the search has ended. Changes nothing once it has answered.
  template <OrderHost Host>
  const Need* next(Host& host) {
    if (ended_ || waiting_) return ended_ ? nullptr : &need_;
    for (; !open_.empty(); open_.pop()) {
      if (const auto limit = log_.evaluation_limit()) return end(*limit);
      const OpenEntry& head = open_.top();
      need_ = {log_.node(head.node).state, head.edge, head.action};
      if (!drop_known_duplicate(head, host)) {
        waiting_ = true;
        return &need_;
      }
    }
    return end(EndReason::exhausted);
  }

  /// The outcome of what next() asked for.
  template <OrderHost Host>
  Committed commit(const Outcome& outcome, Host& host) {
    using Verdict = typename Log::Verdict;
    const OpenEntry head = open_.top();
    open_.pop();
    waiting_ = false;
    log_.book(need_.parent, need_.action, outcome);
    if (!outcome.report.valid) {
      log_.record(need_.parent, need_.action, head.g, Verdict::invalid);
      return {};
    }
    if (const StateId closer = table_.closed_by(outcome.child); closer != kNoState) {
      ++log_.counters().duplicates;
      log_.count_merge(closer != outcome.child);
      log_.record(need_.parent, need_.action, head.g, Verdict::duplicate, outcome.child);
      return {};
    }
    log_.record(need_.parent, need_.action, head.g, Verdict::accepted, outcome.child);
    close({outcome.child, head.node, head.action, head.g}, head.f, host);
    return {outcome.child, kNoState, head.g};
  }

  /// Ends the search from outside (a stop, an exception).
  void abort(EndReason reason) {
    if (!ended_) end(reason);
  }
  bool ended() const { return ended_; }
  SearchResult<State> result() const { return log_.result(reason_, goal_, open_); }
  SearchProgress progress() const { return log_.progress(open_); }
  const OpenList& open() const { return open_; }
  const Log& log() const { return log_; }
  const Weight& weight() const { return weight_; }
  static constexpr bool kLazy = true;

 private:
  const Need* end(EndReason reason) {
    ended_ = true;
    reason_ = reason;
    return nullptr;
  }

  template <OrderHost Host>
  void close(const typename Log::Node& node, Cost f, Host& host) {
    table_.close(node.state);
    const std::int32_t index = log_.add_node(node);
    if (domain_.is_goal(table_.state(node.state))) {
      goal_ = index;
      end(EndReason::goal);
      return;
    }
    if (const auto limit = log_.expansion_limit()) {
      open_.push({f, node.g, seq_++, index, -1, 0, -1});  // for the lower bound: not expanded
      end(*limit);
      return;
    }
    ++log_.counters().expansions;
    const std::span<const LazyEdge> edges = host.successors(node.state).value();
    std::int32_t i = 0;
    for (const LazyEdge& edge : edges) {
      if (edge.heuristic >= kUnreachable) {
        ++log_.counters().pruned_infinite;
      } else {
        const Cost g = node.g + edge.cost;
        open_.push({weight_.f(g, edge.heuristic), g, seq_++, index, i, edge.action, -1});
        ++log_.counters().generated;
      }
      ++i;
    }
  }

  template <OrderHost Host>
  bool drop_known_duplicate(const OpenEntry& head, Host& host) {
    const StateId child = host.known_child(need_);
    const StateId closer = child == kNoState ? kNoState : table_.closed_by(child);
    if (closer == kNoState) return false;
    ++log_.counters().known_duplicates;
    log_.count_merge(closer != child);
    log_.record(need_.parent, need_.action, head.g, Log::Verdict::known_duplicate, child);
    host.dropped(need_);
    return true;
  }

  const D& domain_;
  Table& table_;
  const SearchOptions& options_;
  Weight weight_;
  Log log_;
  OpenList open_;
  std::int64_t seq_ = 0;
  Need need_;
  std::int32_t goal_ = -1;
  bool waiting_ = false;  // next() has answered, commit() not yet come
  bool ended_ = false;
  EndReason reason_ = EndReason::exhausted;
};

}  // namespace mamo::search
