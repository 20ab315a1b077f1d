// Decides who evaluates what, and commits outcomes in serial order. A plain data structure: no threads, no clock.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "mamo/search/parallel_options.hpp"
#include "mamo/search/shadow_graph.hpp"
#include "mamo/search/trace.hpp"

namespace mamo::search {

/// The scheduler of the parallel searches: "in-order commit, bench-ordered runahead". A driver calls take() and
/// finish() for its workers, under one lock or in virtual time; between the two calls a worker evaluates on its own.
/// There is no thread for committing: whoever finishes the edge that the order needs runs the order on as far as
/// outcomes are there, and takes the next needed edge itself.
///
/// Identity. The order (LazyOrder, EagerOrder) is the serial algorithm; it gets the outcome of each edge it asks for
/// and nothing else. By induction on commits: OPEN after k commits is a function of the first k (edge, outcome)
/// pairs; an outcome is a pure function of (state, action); so the k+1st need is the serial one. Sequence numbers are
/// given at commit, ids never compared or shown. Hence path, cost, bound, counters and order hash are those of the
/// serial search, for every schedule, number of workers and interleaving; so is an exception: it is kept and raised
/// when its turn comes. Only a stop from outside can cut the sequence elsewhere, and then it is a prefix.
///
/// Never slower: the needed edge, if nobody has taken it, is what take() gives out first.
///
/// Progress: unless ended, the needed edge is fresh (the next take() gets it) or running (its worker will finish);
/// so one worker that keeps calling is enough.
///
/// Prior art: lazy weighted A* (Cohen et al. 2015); Runahead A* (ICAPS 2023) speculates for the same order with
/// memoised checks; PA*SE, ePA*SE, GePA*SE (Phillips et al. 2014, Mukherjee et al. 2022-23) and MPLP (2022) commit out
/// of order and need child states before edges are evaluated; Swarm (Jeffrey et al. 2015) commits in order in
/// hardware. Here outcomes decide children, and the bench key decides what is worth running ahead.
template <template <class, class> class OrderT, Domain D>
class Scheduler {
 public:
  using Table = StateTable<D>;
  using Order = OrderT<D, Table>;

  struct Job {
    Need need;          // edge kSuccessors: generate the parent's successors
    bool head = false;  // the order waits for it
    bool generates() const { return need.edge == Need::kSuccessors; }
  };
  struct Finished {
    Outcome outcome;
    std::unique_ptr<Expansion> expansion;  // of the child, or of the parent if the job generates
    std::exception_ptr error;              // what the evaluation threw
    std::exception_ptr expansion_error;    // what generating the successors threw
    double seconds = 0;                    // thread CPU time, if measured
  };

  /// slots: jobs that a worker may hold at once; worker w has the slots w * slots .. (w + 1) * slots - 1.
  Scheduler(const D& domain, Table& table, const SearchOptions& options, const ParallelOptions& parallel, int workers,
            int slots = 1)
      : table_(table),
        parallel_(parallel),
        order_(domain, table, options),
        graph_(table, order_.weight(), parallel.schedule == Schedule::runahead),
        workers_(workers),
        slots_per_worker_(slots),
        slots_(static_cast<std::size_t>(workers * slots)) {
    graph_.on_death = [this](std::int32_t slot) { cancel(slot); };
  }

  /// expansion: of the start, if the order is lazy.
  void begin(StateId start, std::unique_ptr<Expansion> expansion, double now = 0) {
    graph_.adopt(start, std::move(expansion));
    order_.begin(start, *this);
    if constexpr (Order::kLazy) {
      if (!order_.ended()) graph_.close(start, 0);
    } else {
      graph_.open(start, 0);
    }
    advance(now);
  }

  /// Something to do for a free slot, or nothing for now (or for good, if ended()).
  std::optional<Job> take(int slot, double now = 0) {
    if (order_.ended()) return std::nullopt;
    Job job{*need_, true};
    if (!head_is_fresh()) {
      const auto ahead = find_ahead();
      if (!ahead) {
        dry_ = true;
        return std::nullopt;
      }
      job = {*ahead, false};
    } else if (parallel_.schedule == Schedule::batch && !in_round(job.need)) {
      begin_round();
    }
    claim(slot, job, now);
    return job;
  }

  /// The job of a slot is over.
  void finish(int index, Finished finished, double now = 0) {
    Slot& slot = slots_[static_cast<std::size_t>(index)];
    const Job job = slot.job;
    slot.busy = false;
    if (job.generates()) {
      finish_generation(job.need.parent, std::move(finished));
    } else {
      finish_evaluation(slot, std::move(finished), now);
    }
    resume_deferred(slot);
    advance(now);
  }

  /// A job that was taken and not begun: somebody else may have it.
  void give_back(int index) {
    Slot& slot = slots_[static_cast<std::size_t>(index)];
    slot.busy = false;
    const Need need = slot.job.need;
    if (slot.job.generates()) {
      graph_.at(need.parent).generating = false;
    } else {
      Cell& c = cell(need);
      --stats_.evaluations;
      if (c.phase == CellPhase::running) {
        release(need, c);
        c.phase = CellPhase::fresh;
      }
      forget(c);
    }
    graph_.rewind(need.parent);
    resume_deferred(slot);
  }

  bool ended() const { return order_.ended(); }
  /// Whether the order waits for something that nobody has taken.
  bool head_waits() { return !order_.ended() && head_is_fresh(); }
  /// Whether another worker might find something to take.
  bool has_work() {
    if (graph_.changed()) dry_ = false;
    return !order_.ended() && (head_is_fresh() || !dry_);
  }
  /// Raised when the evaluation in a slot should be given up. Read unlocked.
  const std::atomic<bool>* cancel_flag(int slot) const { return &slots_[static_cast<std::size_t>(slot)].cancel; }
  /// Raised when the order has come to an edge that is in a slot: a worker with several jobs hands in what it has
  /// done. Read unlocked.
  bool awaited(int slot) const {
    return slots_[static_cast<std::size_t>(slot)].awaited.load(std::memory_order_relaxed);
  }
  void abort(EndReason reason) {
    order_.abort(reason);
    cancel_all();
  }

  SearchResult<typename D::State> result() const { return order_.result(); }
  SearchProgress progress() const { return order_.progress(); }
  const Weight& weight() const { return order_.weight(); }
  const ParallelStats& stats() const { return stats_; }
  /// For a trace, when all is over.
  const Expansion* expansion(StateId id) const {
    const auto* s = graph_.peek(id);
    return s ? s->expansion.get() : nullptr;
  }

  // What the order asks (OrderHost).
  std::optional<std::span<const LazyEdge>> successors(StateId state) {
    const auto& s = graph_.at(state);
    if (s.expansion) return std::span<const LazyEdge>(s.expansion->edges);
    if (s.failed) std::rethrow_exception(errors_.at(error_key(state, Need::kSuccessors)));
    return std::nullopt;
  }
  StateId known_child(const Need& need) { return cell(need).known; }
  void dropped(const Need& need) {
    Cell& c = cell(need);
    if (c.phase == CellPhase::running) cancel(c.slot);
    release(need, c);
    if (c.phase == CellPhase::done) forget(c);
    c.phase = CellPhase::gone;
  }

 private:
  struct alignas(64) Slot {
    std::atomic<bool> cancel{false};
    std::atomic<bool> awaited{false};
    bool busy = false;
    Job job;
    StateId known = kNoState;       // the child it will have if valid, where the domain predicts one
    Cost g = 0;                     // and its g
    std::vector<StateId> deferred;  // states that put off an edge to the same child
  };

  /// What a running or done cell holds besides.
  struct Evaluation {
    EdgeReport report;
    float seconds = 0;        // thread CPU time, if measured
    std::int32_t trace = -1;  // job in the trace
  };
  Evaluation& evaluation(const Cell& c) { return evaluations_[static_cast<std::size_t>(c.evaluation)]; }
  void remember(Cell& c) {
    if (spare_.empty()) {
      spare_.push_back(static_cast<std::int32_t>(evaluations_.size()));
      evaluations_.emplace_back();
    }
    c.evaluation = spare_.back();
    spare_.pop_back();
    evaluation(c) = {};
  }
  void forget(Cell& c) {
    spare_.push_back(c.evaluation);
    c.evaluation = -1;
  }

  Cell& cell(const Need& need) { return graph_.at(need.parent).expansion->cells[static_cast<std::size_t>(need.edge)]; }
  Need need_of(StateId state, std::int32_t edge) {
    if (edge == Need::kSuccessors) return {state, edge, 0};
    return {state, edge, graph_.at(state).expansion->edges[static_cast<std::size_t>(edge)].action};
  }
  static std::uint64_t error_key(StateId state, std::int32_t edge) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(state.value)) << 32 | static_cast<std::uint32_t>(edge);
  }
  bool head_is_fresh() {
    if (need_->edge == Need::kSuccessors) return !graph_.at(need_->parent).generating;
    return cell(*need_).phase == CellPhase::fresh;
  }
  void cancel(std::int32_t slot) {
    slots_[static_cast<std::size_t>(slot)].cancel.store(true, std::memory_order_relaxed);
  }
  void cancel_all() {
    for (Slot& slot : slots_) {
      if (slot.busy) slot.cancel.store(true, std::memory_order_relaxed);
    }
  }

  void resume_deferred(Slot& slot) {
    for (const StateId state : slot.deferred) graph_.rewind(state);
    slot.deferred.clear();
  }

  void claim(int index, const Job& job, double now) {
    Slot& slot = slots_[static_cast<std::size_t>(index)];
    slot.cancel.store(false, std::memory_order_relaxed);
    slot.awaited.store(job.head, std::memory_order_relaxed);
    slot.busy = true;
    slot.job = job;
    slot.known = kNoState;
    auto& s = graph_.at(job.need.parent);
    if (job.generates()) {
      s.generating = true;
      return;
    }
    Cell& c = cell(job.need);
    c.phase = CellPhase::running;
    c.slot = index;
    remember(c);
    slot.known = c.known;
    slot.g = s.g + s.expansion->edges[static_cast<std::size_t>(job.need.edge)].cost;
    ++stats_.evaluations;
    if (bounded()) {
      const BenchKey key = graph_.key_of(s, job.need.edge);
      ahead_keys_.insert(key);
      key_of_cell_.insert_or_assign(error_key(job.need.parent, job.need.edge), key);
    }
    if (parallel_.trace) {
      evaluation(c).trace = parallel_.trace->begin_job(job.need, index / slots_per_worker_, job.head, now);
    }
  }

  void finish_generation(StateId state, Finished finished) {
    auto& s = graph_.at(state);
    s.generating = false;
    adopt(state, finished);
    if (s.round == round_ && s.expansion) join_round(state);
    dry_ = false;
  }
  void adopt(StateId state, Finished& finished) {
    if (finished.expansion_error) {
      graph_.at(state).failed = true;
      errors_.emplace(error_key(state, Need::kSuccessors), finished.expansion_error);
    }
    if (finished.expansion) table_.set_expanded(state);
    graph_.adopt(state, std::move(finished.expansion));
  }

  void finish_evaluation(Slot& slot, Finished finished, double now) {
    const Need need = slot.job.need;
    Cell& c = cell(need);
    stats_.evaluation_s += finished.seconds;
    stats_.charge += finished.outcome.report.charge;
    if (parallel_.trace) parallel_.trace->end_job(evaluation(c).trace, finished.outcome, finished.seconds, now);
    if (c.phase != CellPhase::running) return forget(c);  // dropped meanwhile
    if (finished.outcome.report.cancelled && !finished.error) {
      ++stats_.cancelled;
      release(need, c);
      forget(c);
      c.phase = CellPhase::fresh;
      graph_.rewind(need.parent);
      if (!slot.cancel.load(std::memory_order_relaxed)) abort(EndReason::stopped);
      return;
    }
    c.phase = CellPhase::done;
    evaluation(c).seconds = static_cast<float>(finished.seconds);
    evaluation(c).report = finished.outcome.report;
    c.valid = finished.outcome.report.valid && !finished.error;
    c.child = finished.outcome.child;
    if (finished.error) {
      c.failed = true;
      errors_.emplace(error_key(need.parent, need.edge), finished.error);
    } else if (c.valid) {
      slot.deferred.clear();  // what was put off for this child is superfluous
      adopt(c.child, finished);
      graph_.link(need.parent, need.edge, c.child);
    }
  }

  /// Runs the order as far as outcomes are there. The only place where anything is committed.
  void advance(double now) {
    while (!order_.ended()) {
      need_ = order_.next(*this);
      if (!need_) break;
      if constexpr (!Order::kLazy) close_expanding();
      meet_head(now);
      if (need_->edge == Need::kSuccessors) {
        if (graph_.at(need_->parent).failed) successors(need_->parent);  // throws
        break;
      }
      Cell& c = cell(*need_);
      if (c.phase != CellPhase::done) break;
      commit(*need_, c, now);
    }
    if (order_.ended()) cancel_all();
  }

  void close_expanding() {
    const StateId state = order_.expanding();
    if (state != kNoState && !graph_.at(state).closed) graph_.close(state, order_.expanding_g());
  }

  void commit(const Need need, Cell& c, double now) {
    if (c.failed) std::rethrow_exception(errors_.at(error_key(need.parent, need.edge)));
    release(need, c);
    const Evaluation done = evaluation(c);
    forget(c);
    c.phase = CellPhase::gone;
    ++stats_.used;
    stats_.used_s += static_cast<double>(done.seconds);
    if (parallel_.trace) parallel_.trace->commit_job(done.trace, now);
    const Committed committed = order_.commit({done.report, c.child}, *this);
    head_met_ = false;
    dry_ = false;
    if (committed.closed != kNoState) graph_.close(committed.closed, committed.g);
    if (committed.opened != kNoState) graph_.open(committed.opened, committed.g);
  }

  /// Statistics of a need that is seen for the first time.
  void meet_head(double now) {
    if (head_met_ || need_->edge == Need::kSuccessors) return;
    head_met_ = true;
    const Cell& c = cell(*need_);
    ++stats_.heads;
    stats_.heads_done += c.phase == CellPhase::done;
    stats_.heads_running += c.phase == CellPhase::running;
    if (c.phase == CellPhase::running) {
      slots_[static_cast<std::size_t>(c.slot)].awaited.store(true, std::memory_order_relaxed);
    }
    if (parallel_.trace) parallel_.trace->need(*need_, c.evaluation < 0 ? -1 : evaluation(c).trace, now);
  }

  // --- what to evaluate ahead ---------------------------------------------------------------------------

  bool bounded() const { return parallel_.schedule == Schedule::runahead && parallel_.batch > 0; }

  std::optional<Need> find_ahead() {
    if (parallel_.schedule == Schedule::batch) return find_in_round();
    if (parallel_.schedule == Schedule::window && parallel_.batch > 0) return find_in_top();
    while (const auto best = graph_.best()) {
      const auto [state, edge] = *best;
      if (edge == Need::kSuccessors) {
        graph_.pass();
        return need_of(state, edge);
      }
      if (bounded() && too_far(graph_.key_of(graph_.at(state), edge))) return std::nullopt;
      const bool worth = worth_it(state, edge, true);
      graph_.pass();
      if (worth) return need_of(state, edge);
    }
    return std::nullopt;
  }

  /// An edge to a known child is not worth an evaluation ahead of its turn if that child is closed, or has been
  /// reached (is being reached) as cheaply: then the serial order will most likely drop the edge unevaluated.
  bool worth_it([[maybe_unused]] StateId state, [[maybe_unused]] std::int32_t edge, [[maybe_unused]] bool defer) {
    if constexpr (PredictsChild<D>) {
      auto& s = graph_.at(state);
      const StateId known = s.expansion->cells[static_cast<std::size_t>(edge)].known;
      if (known == kNoState) return true;
      if (table_.closed_by(known) != kNoState) return false;
      const Cost g = s.g + s.expansion->edges[static_cast<std::size_t>(edge)].cost;
      if (const auto* child = graph_.peek(known); child && child->alive && child->g <= g) return false;
      for (Slot& slot : slots_) {
        if (slot.busy && slot.known == known && slot.g <= g) {
          if (defer) slot.deferred.push_back(state);
          return false;
        }
      }
    }
    return true;
  }

  /// Schedule runahead with a bound: whether K outcomes that would be needed earlier are begun or waiting.
  bool too_far(const BenchKey& key) const {
    int rank = 0;
    for (auto it = ahead_keys_.begin(); it != ahead_keys_.end() && *it < key; ++it) {
      if (++rank >= parallel_.batch) return true;
    }
    return false;
  }
  void release(const Need& need, const Cell& c) {
    if (!bounded() || (c.phase != CellPhase::running && c.phase != CellPhase::done)) return;
    const auto it = key_of_cell_.find(error_key(need.parent, need.edge));
    if (it == key_of_cell_.end()) return;
    ahead_keys_.erase(ahead_keys_.find(it->second));
    key_of_cell_.erase(it);
  }

  /// Visits the fresh edges (and successors to be generated) of the best `count` entries of OPEN, best first, and of
  /// the state being expanded, until visit returns true.
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
    if (!graph_.at(state).alive) return false;
    if (!graph_.at(state).expansion) return visit(state, Need::kSuccessors);
    for (const std::int32_t edge : graph_.at(state).expansion->order) {
      if (visit(state, edge)) return true;
    }
    return false;
  }
  bool takeable(StateId state, std::int32_t edge) {
    auto& s = graph_.at(state);
    if (edge == Need::kSuccessors) return !s.generating && !s.failed && !s.expansion;
    return s.expansion->cells[static_cast<std::size_t>(edge)].phase == CellPhase::fresh && worth_it(state, edge, false);
  }

  std::optional<Need> find_in_top() {
    std::optional<Need> found;
    visit_top(parallel_.batch, [&](StateId state, std::int32_t edge) {
      if (takeable(state, edge)) found = need_of(state, edge);
      return found.has_value();
    });
    return found;
  }

  // Schedule batch: a round is what the best entries of OPEN were when the order asked for an edge outside the last.

  bool in_round(const Need& need) {
    if (need.edge == Need::kSuccessors) return graph_.at(need.parent).round == round_;
    return cell(need).round == round_;
  }
  void begin_round() {
    ++round_;
    round_list_.clear();
    round_next_ = 0;
    const int count = parallel_.batch > 0 ? parallel_.batch : workers_;
    visit_top(count, [&](StateId state, std::int32_t edge) {
      add_to_round(state, edge);
      return false;
    });
    for (Slot& slot : slots_) {  // the barrier: what fell out of the batch gives up
      if (slot.busy && !slot.job.generates() && !in_round(slot.job.need)) {
        slot.cancel.store(true, std::memory_order_relaxed);
      }
    }
    dry_ = false;
  }
  void add_to_round(StateId state, std::int32_t edge) {
    if (edge == Need::kSuccessors) {
      graph_.at(state).round = round_;
    } else {
      graph_.at(state).expansion->cells[static_cast<std::size_t>(edge)].round = round_;
    }
    round_list_.push_back({state, edge});
  }
  void join_round(StateId state) {
    for (const std::int32_t edge : graph_.at(state).expansion->order) add_to_round(state, edge);
    dry_ = false;
  }
  std::optional<Need> find_in_round() {
    for (; round_next_ < round_list_.size(); ++round_next_) {
      const auto [state, edge] = round_list_[round_next_];
      if (takeable(state, edge)) return need_of(state, edge);
    }
    return std::nullopt;
  }

  Table& table_;
  const ParallelOptions& parallel_;
  Order order_;
  ShadowGraph<D, Order::kLazy> graph_;
  const int workers_, slots_per_worker_;
  std::vector<Slot> slots_;
  std::vector<Evaluation> evaluations_;  // referred to by cells
  std::vector<std::int32_t> spare_;      // free ones
  const Need* need_ = nullptr;           // what the order waits for; null once ended
  bool head_met_ = false;
  bool dry_ = false;  // the last look for work ahead found none
  ParallelStats stats_;
  std::unordered_map<std::uint64_t, std::exception_ptr> errors_;
  std::multiset<BenchKey> ahead_keys_;  // of begun and waiting outcomes, if bounded()
  std::unordered_map<std::uint64_t, BenchKey> key_of_cell_;
  std::int32_t round_ = 0;
  std::vector<std::pair<StateId, std::int32_t>> round_list_;
  std::size_t round_next_ = 0;
};

}  // namespace mamo::search
