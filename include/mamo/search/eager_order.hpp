// The serial order of weighted A*, without the evaluations: it says which edge it needs next.
#pragma once

#include <vector>

#include "mamo/search/commit_log.hpp"

namespace mamo::search {

/// Weighted A* (Pohl 1970) without reopening, over a domain whose edges are dear; the same machine as LazyOrder:
///
///     begin(start);  while (const Need* need = next()) commit(<outcome of need>);  result()
///
/// OPEN holds states that were born by an evaluation. One step:
///   1. pop the state of least (f, then larger g, then earlier push); its class closed: drop;
///   2. close its class with it; a goal: end;
///   3. ask for the outcomes of all its edges in order, those with kUnreachable left out; push the valid children
///      whose class is open and that were not reached as cheaply before (a known child that was, or whose class is
///      closed, costs no evaluation).
/// With a consistent heuristic and no merged classes cost <= W x optimum. Limits may end an expansion in its middle.
template <class D, class Table>
class EagerOrder {
 public:
  static_assert(Domain<D>);
  using Log = CommitLog<D, Table>;
  using State = typename D::State;

  EagerOrder(const D& domain, Table& table, const SearchOptions& options)
      : domain_(domain), table_(table), options_(options), weight_(options.weight), log_(domain, table, options) {}

  template <OrderHost Host>
  void begin(StateId start, Host&) {
    const Cost h = domain_.heuristic(table_.state(start));
    if (h >= kUnreachable) {
      ++log_.counters().pruned_infinite;
    } else {
      push(weight_.f(0, h), 0, -1, -1, 0, start);
    }
  }

  /// The next edge of the state being expanded, or {state, kSuccessors} of the state about to be expanded, or null
  /// when the search has ended.
  template <OrderHost Host>
  const Need* next(Host& host) {
    while (!ended_ && !waiting_) {
      if (node_ < 0) {
        if (!expand_best(host)) return &need_;
      } else if (!find_edge(host)) {
        node_ = -1;
      } else if (const auto limit = log_.evaluation_limit()) {
        end(*limit);
      } else {
        waiting_ = true;
      }
    }
    return ended_ ? nullptr : &need_;
  }

  /// The outcome of what next() asked for. States close in next(): the parent of a need is closed.
  template <OrderHost Host>
  Committed commit(const Outcome& outcome, Host&) {
    using Verdict = typename Log::Verdict;
    waiting_ = false;
    const LazyEdge& edge = edges_[edge_++];
    const Cost g = log_.node(node_).g + edge.cost;
    log_.book(need_.parent, need_.action, outcome);
    if (!outcome.report.valid) {
      log_.record(need_.parent, need_.action, g, Verdict::invalid);
      return {};
    }
    const StateId closer = table_.closed_by(outcome.child);
    const bool cheaper = closer == kNoState && improves(outcome.child, g);
    log_.record(need_.parent, need_.action, g, cheaper ? Verdict::accepted : Verdict::duplicate, outcome.child);
    if (cheaper) {
      push(weight_.f(g, edge.heuristic), g, node_, need_.edge, need_.action, outcome.child);
      return {kNoState, outcome.child, g};
    }
    ++log_.counters().duplicates;
    log_.count_merge(closer != kNoState && closer != outcome.child);
    return {};
  }

  void abort(EndReason reason) {
    if (!ended_) end(reason);
  }
  bool ended() const { return ended_; }
  SearchResult<State> result() const { return log_.result(reason_, goal_, open_); }
  SearchProgress progress() const { return log_.progress(open_); }
  const OpenList& open() const { return open_; }
  const Log& log() const { return log_; }
  const Weight& weight() const { return weight_; }
  /// The state whose edges are needed now, and its g.
  StateId expanding() const { return node_ < 0 ? kNoState : log_.node(node_).state; }
  Cost expanding_g() const { return log_.node(node_).g; }
  static constexpr bool kLazy = false;

 private:
  bool end(EndReason reason) {
    ended_ = true;
    reason_ = reason;
    if (node_ >= 0 && goal_ < 0) open_.push(head_);  // for the lower bound: its expansion is not complete
    return true;
  }
  void push(Cost f, Cost g, std::int32_t parent, std::int32_t edge, std::int32_t action, StateId state) {
    open_.push({f, g, seq_++, parent, edge, action, state.value});
    ++log_.counters().generated;
  }

  /// Closes the best state of OPEN and makes it the one being expanded, unless the search ends. False: need_ names
  /// the state whose successors must be generated first; nothing has changed.
  template <OrderHost Host>
  bool expand_best(Host& host) {
    for (; !open_.empty(); open_.pop()) {
      const StateId state(open_.top().state);
      const StateId closer = table_.closed_by(state);
      if (closer == kNoState) break;
      log_.count_merge(closer != state);
    }
    if (open_.empty()) return end(EndReason::exhausted);
    head_ = open_.top();
    const StateId state(head_.state);
    const bool goal = domain_.is_goal(table_.state(state));
    if (const auto limit = log_.expansion_limit(); limit && !goal) return end(*limit);
    if (!goal) {
      const auto successors = host.successors(state);
      need_ = {state, Need::kSuccessors, 0};
      if (!successors) return false;
      edges_.assign(successors->begin(), successors->end());
      edge_ = 0;
    }
    open_.pop();
    table_.close(state);
    node_ = log_.add_node({state, head_.node, head_.action, head_.g});
    if (goal) {
      goal_ = node_;
      return end(EndReason::goal);
    }
    ++log_.counters().expansions;
    return true;
  }

  /// Finds the next edge worth asking for. False when the expansion is complete.
  template <OrderHost Host>
  bool find_edge(Host& host) {
    const StateId parent = log_.node(node_).state;
    for (; edge_ < edges_.size(); ++edge_) {
      const LazyEdge& edge = edges_[edge_];
      need_ = {parent, static_cast<std::int32_t>(edge_), edge.action};
      if (edge.heuristic >= kUnreachable) {
        ++log_.counters().pruned_infinite;
      } else if (!drop_known_duplicate(log_.node(node_).g + edge.cost, host)) {
        return true;
      }
    }
    return false;
  }

  template <OrderHost Host>
  bool drop_known_duplicate(Cost g, Host& host) {
    const StateId child = host.known_child(need_);
    if (child == kNoState) return false;
    const StateId closer = table_.closed_by(child);
    if (closer == kNoState && g < best_g(child)) return false;
    ++log_.counters().known_duplicates;
    log_.count_merge(closer != kNoState && closer != child);
    log_.record(need_.parent, need_.action, g, Log::Verdict::known_duplicate, child);
    host.dropped(need_);
    return true;
  }

  /// The cheapest g at which an exact state was reached.
  Cost best_g(StateId state) const { return state.index() < best_g_.size() ? best_g_[state.index()] : kUnreachable; }
  bool improves(StateId state, Cost g) {
    if (g >= best_g(state)) return false;
    if (best_g_.size() <= state.index()) best_g_.resize(2 * state.index() + 64, kUnreachable);
    best_g_[state.index()] = g;
    return true;
  }

  const D& domain_;
  Table& table_;
  const SearchOptions& options_;
  Weight weight_;
  Log log_;
  OpenList open_;
  std::int64_t seq_ = 0;
  std::int32_t node_ = -1;  // being expanded, popped as head_
  OpenEntry head_;
  std::vector<LazyEdge> edges_;
  std::size_t edge_ = 0;
  std::vector<Cost> best_g_;  // by state id; decides, but is never iterated
  Need need_;
  std::int32_t goal_ = -1;
  bool waiting_ = false, ended_ = false;
  EndReason reason_ = EndReason::exhausted;
};

}  // namespace mamo::search
