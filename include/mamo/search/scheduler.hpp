// Decides who evaluates what, and commits outcomes in serial order. A plain data structure: no threads, no clock.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mamo/search/lookahead.hpp"
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
  using Job = search::Job;

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
        slots_per_worker_(slots),
        slots_(static_cast<std::size_t>(workers * slots)),
        lookahead_(table, order_, graph_, slots_, parallel, workers) {
    graph_.on_death = [this](StateId state) { abandon(state); };
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
      const auto ahead = lookahead_.find();
      if (!ahead) {
        dry_ = true;
        return std::nullopt;
      }
      job = {*ahead, false};
    } else if (lookahead_.head_taken(job.need)) {
      dry_ = false;
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
        lookahead_.released(need);
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
    lookahead_.released(need);
    if (c.phase == CellPhase::done) forget(c);
    c.phase = CellPhase::gone;
  }

 private:
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

  /// A state has died.
  void abandon(StateId state) {
    const auto& s = graph_.at(state);
    for (std::size_t i = 0; s.expansion && i < s.expansion->cells.size(); ++i) {
      const Cell& c = s.expansion->cells[i];
      if (c.phase == CellPhase::running) cancel(c.slot);
      if (c.phase == CellPhase::done) lookahead_.released({state, static_cast<std::int32_t>(i), 0});
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
    lookahead_.claimed(job.need);
    if (parallel_.trace) {
      evaluation(c).trace = parallel_.trace->begin_job(job.need, index / slots_per_worker_, job.head, now);
    }
  }

  void finish_generation(StateId state, Finished finished) {
    auto& s = graph_.at(state);
    s.generating = false;
    adopt(state, finished);
    lookahead_.generated(state);
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
      lookahead_.released(need);
      forget(c);
      c.phase = CellPhase::fresh;
      graph_.rewind(need.parent);
      if (!slot.cancel.load(std::memory_order_relaxed)) abort(EndReason::stopped);
      return;
    }
    c.phase = CellPhase::done;
    if (!graph_.at(need.parent).alive) lookahead_.released(need);  // too late for abandon() to do it
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
    lookahead_.released(need);
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

  Table& table_;
  const ParallelOptions& parallel_;
  Order order_;
  ShadowGraph<D, Order::kLazy> graph_;
  const int slots_per_worker_;
  std::vector<Slot> slots_;
  Lookahead<D, Order> lookahead_;
  std::vector<Evaluation> evaluations_;  // referred to by cells
  std::vector<std::int32_t> spare_;      // free ones
  const Need* need_ = nullptr;           // what the order waits for; null once ended
  bool head_met_ = false;
  bool dry_ = false;  // the last look for work ahead found none
  ParallelStats stats_;
  std::unordered_map<std::uint64_t, std::exception_ptr> errors_;
};

}  // namespace mamo::search
