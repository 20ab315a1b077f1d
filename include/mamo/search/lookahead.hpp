// What may be evaluated before the serial order asks for it: the three schedules.
#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "mamo/search/open_list.hpp"
#include "mamo/search/parallel_options.hpp"
#include "mamo/search/shadow_graph.hpp"

namespace mamo::search {

struct Job {
  Need need;          // edge kSuccessors: generate the parent's successors
  bool head = false;  // the order waits for it
  bool generates() const { return need.edge == Need::kSuccessors; }
};

/// Where a worker keeps a job. Apart from the flags, which it reads unlocked, for the scheduler only.
struct alignas(64) Slot {
  std::atomic<bool> cancel{false};
  std::atomic<bool> awaited{false};
  bool busy = false;
  Job job;
  StateId known = kNoState;       // the child it will have if valid, where the domain predicts one
  Cost g = 0;                     // and its g
  std::vector<StateId> deferred;  // states that put off an edge to the same child
};

/// Chooses among the fresh edges. Everything in here may be wrong without any harm but lost time.
///
///   runahead  the best entry of PENDING (ShadowGraph). With a bound K, only while fewer than K evaluations that would
///             be needed earlier are running or waiting for their turn.
///   window    the same without shadows; with a bound K, the first fresh edge among the K best entries of OPEN.
///   batch     the edges of a round: the K best entries of OPEN (kRoundPerWorker times workers, by default) at the
///             moment when the order asked for an edge outside the last round. What is running outside the new round
///             is cancelled; within a round, workers that find no fresh edge wait. The plain reference that the
///             other two are compared with.
template <Domain D, class Order>
class Lookahead {
 public:
  using Graph = ShadowGraph<D, Order::kLazy>;
  static constexpr int kRoundPerWorker = Order::kLazy ? 16 : 1;  // edges, or states with all their edges

  Lookahead(const StateTable<D>& table, const Order& order, Graph& graph, std::vector<Slot>& slots,
            const ParallelOptions& parallel, int workers)
      : table_(table), order_(order), graph_(graph), slots_(slots), parallel_(parallel), workers_(workers) {}

  std::optional<Need> find() {
    if (parallel_.schedule == Schedule::batch) return find_in_round();
    if (parallel_.schedule == Schedule::window && parallel_.batch > 0) return find_in_top();
    while (const auto best = graph_.best()) {
      const auto [state, edge] = *best;
      if (edge != Need::kSuccessors && bounded() && too_far(graph_.key_of(graph_.at(state), edge))) return std::nullopt;
      const bool worth = edge == Need::kSuccessors || worth_it(state, edge, true);
      graph_.pass();
      if (worth) return need_of(state, edge);
    }
    return std::nullopt;
  }

  /// The head of the order is given out. True: there may be more to find than before.
  bool head_taken(const Need& need) {
    if (parallel_.schedule != Schedule::batch || in_round(need)) return false;
    begin_round();
    return true;
  }
  /// The successors of a state have been generated.
  void generated(StateId state) {
    const auto& s = graph_.at(state);
    if (s.round != round_ || !s.expansion) return;
    for (const std::int32_t edge : s.expansion->order) add_to_round(state, edge);
  }
  /// An evaluation begins.
  void claimed(const Need& need) {
    if (!bounded()) return;
    const BenchKey key = graph_.key_of(graph_.at(need.parent), need.edge);
    ahead_.insert(key);
    key_of_.insert_or_assign(name_of(need), key);
  }
  /// An evaluation is committed, cancelled, or can no longer be needed.
  void released(const Need& need) {
    const auto it = key_of_.find(name_of(need));
    if (it == key_of_.end()) return;
    ahead_.erase(ahead_.find(it->second));
    key_of_.erase(it);
  }

 private:
  Need need_of(StateId state, std::int32_t edge) {
    if (edge == Need::kSuccessors) return {state, edge, 0};
    return {state, edge, graph_.at(state).expansion->edges[static_cast<std::size_t>(edge)].action};
  }
  Cell& cell(StateId state, std::int32_t edge) {
    return graph_.at(state).expansion->cells[static_cast<std::size_t>(edge)];
  }
  static std::uint64_t name_of(const Need& need) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(need.parent.value)) << 32 |
           static_cast<std::uint32_t>(need.edge);
  }

  /// An edge to a known child is not worth an evaluation ahead of its turn if that child is closed, or has been
  /// reached (is being reached) as cheaply: then the serial order will most likely drop the edge unevaluated.
  /// defer: have the state's edges looked at again if the evaluation on the way to the child comes to nothing.
  bool worth_it([[maybe_unused]] StateId state, [[maybe_unused]] std::int32_t edge, [[maybe_unused]] bool defer) {
    if constexpr (PredictsChild<D>) {
      const auto& s = graph_.at(state);
      const StateId known = cell(state, edge).known;
      if (known == kNoState) return true;
      if (table_.closed_by(known) != kNoState) return false;
      const Cost g = s.g + s.expansion->edges[static_cast<std::size_t>(edge)].cost;
      if (const auto* child = graph_.peek(known); child && child->alive && child->g <= g) return false;
      for (Slot& slot : slots_) {
        if (!slot.busy || slot.known != known || slot.g > g) continue;
        if (defer) slot.deferred.push_back(state);
        return false;
      }
    }
    return true;
  }

  // Runahead with a bound.

  bool bounded() const { return parallel_.schedule == Schedule::runahead && parallel_.batch > 0; }
  bool too_far(const BenchKey& key) const {
    int rank = 0;
    for (auto it = ahead_.begin(); it != ahead_.end() && *it < key; ++it) {
      if (++rank >= parallel_.batch) return true;
    }
    return false;
  }

  // The best entries of OPEN.

  /// Visits the edges (or successors to be generated) of the state being expanded and of the best `count` entries of
  /// OPEN, best first, until visit returns true. Leaves the heap as it is.
  template <class Visit>
  void visit_top(int count, Visit visit) {
    if constexpr (!Order::kLazy) {
      if (order_.expanding() != kNoState && visit_edges(order_.expanding(), visit)) return;
    }
    const std::vector<OpenEntry>& heap = order_.open().heap();
    const auto after = [&](std::size_t a, std::size_t b) { return heap[b].before(heap[a]); };
    std::vector<std::size_t> front;  // heap positions whose parents have been visited
    if (!heap.empty()) front.push_back(0);
    for (; count > 0 && !front.empty(); --count) {
      std::pop_heap(front.begin(), front.end(), after);
      const std::size_t at = front.back();
      front.pop_back();
      if constexpr (Order::kLazy) {
        if (visit(order_.log().node(heap[at].node).state, heap[at].edge)) return;
      } else {
        if (visit_edges(StateId(heap[at].state), visit)) return;
      }
      for (std::size_t child = 2 * at + 1; child <= 2 * at + 2 && child < heap.size(); ++child) {
        front.push_back(child);
        std::push_heap(front.begin(), front.end(), after);
      }
    }
  }
  template <class Visit>
  bool visit_edges(StateId state, Visit& visit) {
    const auto& s = graph_.at(state);
    if (!s.alive) return false;
    if (!s.expansion) return visit(state, Need::kSuccessors);
    return std::any_of(s.expansion->order.begin(), s.expansion->order.end(),
                       [&](std::int32_t edge) { return visit(state, edge); });
  }
  bool takeable(StateId state, std::int32_t edge) {
    const auto& s = graph_.at(state);
    if (edge == Need::kSuccessors) return !s.generating && !s.failed && !s.expansion;
    return cell(state, edge).phase == CellPhase::fresh && worth_it(state, edge, false);
  }
  std::optional<Need> find_in_top() {
    std::optional<Need> found;
    visit_top(parallel_.batch, [&](StateId state, std::int32_t edge) {
      if (takeable(state, edge)) found = need_of(state, edge);
      return found.has_value();
    });
    return found;
  }

  // Rounds.

  bool in_round(const Need& need) {
    if (need.edge == Need::kSuccessors) return graph_.at(need.parent).round == round_;
    return cell(need.parent, need.edge).round == round_;
  }
  void begin_round() {
    ++round_;
    list_.clear();
    next_ = 0;
    visit_top(parallel_.batch > 0 ? parallel_.batch : kRoundPerWorker * workers_,
              [&](StateId state, std::int32_t edge) {
                add_to_round(state, edge);
                return false;
              });
    for (Slot& slot : slots_) {  // the barrier: what fell out of the batch gives up
      if (slot.busy && !slot.job.generates() && !in_round(slot.job.need)) {
        slot.cancel.store(true, std::memory_order_relaxed);
      }
    }
  }
  void add_to_round(StateId state, std::int32_t edge) {
    (edge == Need::kSuccessors ? graph_.at(state).round : cell(state, edge).round) = round_;
    list_.push_back({state, edge});
  }
  std::optional<Need> find_in_round() {
    for (; next_ < list_.size(); ++next_) {
      const auto [state, edge] = list_[next_];
      if (takeable(state, edge)) return need_of(state, edge);
    }
    return std::nullopt;
  }

  const StateTable<D>& table_;
  const Order& order_;
  Graph& graph_;
  std::vector<Slot>& slots_;
  const ParallelOptions& parallel_;
  const int workers_;
  std::multiset<BenchKey> ahead_;  // of running and waiting evaluations, if bounded()
  std::unordered_map<std::uint64_t, BenchKey> key_of_;
  std::int32_t round_ = 0;
  std::vector<std::pair<StateId, std::int32_t>> list_;  // of the round
  std::size_t next_ = 0;                                // first of the list that may be fresh
};

}  // namespace mamo::search
