// Weighted A* on several threads: the same result as on one.
#pragma once

#include <condition_variable>
#include <mutex>
#include <span>
#include <stdexcept>
#include <vector>

#include "mamo/common/cpu_time.hpp"
#include "mamo/common/executor.hpp"
#include "mamo/search/eager_order.hpp"
#include "mamo/search/lazy_order.hpp"
#include "mamo/search/scheduler.hpp"
#include "mamo/search/serial_search.hpp"

namespace mamo::search {

/// Drives a Scheduler with one worker per context. Every worker runs the same loop: take a batch of jobs under the
/// lock, evaluate them unlocked (intern the children and generate their successors there too), hand them in under the
/// lock, which commits whatever can be committed. Workers without anything to do sleep on a condition variable;
/// nobody spins.
///
/// The lock is held for about a microsecond per job. A batch is one job, unless jobs have lately been shorter than
/// kBatchSeconds: then as many as fill that time. A batch is handed in early when the order comes to one of its edges.
///
/// Stops: the source is asked before every batch, and evaluations poll it themselves (domain.hpp), as well as their
/// cancel flag.
template <template <class, class> class OrderT, Domain D>
class ParallelSearch {
 public:
  using Context = typename D::Context;
  using Sched = Scheduler<OrderT, D>;

  ParallelSearch(const D& domain, std::span<Context> contexts, const SearchOptions& options,
                 const ParallelOptions& parallel)
      : domain_(domain),
        contexts_(contexts),
        options_(options),
        parallel_(parallel),
        measured_(parallel.measure || parallel.trace),
        table_(domain),
        scheduler_(domain, table_, options, parallel, static_cast<int>(contexts.size()), kMaxBatch),
        begun_(StopSource::Clock::now()) {}

  /// Once. Throws what an evaluation threw whose turn had come.
  SearchResult<typename D::State> run() {
    const StateId start = table_.intern(domain_.start());
    if (stopped()) {
      scheduler_.abort(EndReason::stopped);
    } else {
      Worker caller;
      scheduler_.begin(start, Sched::Order::kLazy ? expand_state(caller, start) : nullptr, now());
    }
    if (!scheduler_.ended()) {
      if (parallel_.executor) {
        run_on(*parallel_.executor);
      } else {
        Executor own(static_cast<int>(contexts_.size()));
        run_on(own);
      }
    }
    if (error_) std::rethrow_exception(error_);
    if (parallel_.trace) complete_trace(*parallel_.trace, start);
    return scheduler_.result();
  }
  const ParallelStats& stats() const { return scheduler_.stats(); }

 private:
  void run_on(Executor& executor) {
    if (executor.workers() != static_cast<int>(contexts_.size())) {
      throw std::invalid_argument("a parallel search needs one context per worker of its executor");
    }
    executor.run([this](WorkerId w) { work(w.value); });
  }

  static constexpr int kMaxBatch = 8;
  static constexpr double kBatchSeconds = 100e-6;

  /// A worker's own things.
  struct Worker {
    int index = 0;
    typename StateTable<D>::Writer writer;
    std::vector<LazyEdge> edges;                     // scratch
    std::vector<typename Sched::Job> jobs;           // in slots index * kMaxBatch + 0, 1, ...
    std::vector<typename Sched::Finished> finished;  // of the first jobs, not handed in yet
    std::size_t handed_in = 0;
    double seconds_per_job = kBatchSeconds;  // lately; decides the size of a batch, no result
    int slot(std::size_t job) const { return index * kMaxBatch + static_cast<int>(job); }
  };

  void work(int w) {
    Worker worker;
    worker.index = w;
    std::unique_lock lock(mutex_);
    try {
      for (std::uint32_t step = 0; !scheduler_.ended(); ++step) {
        if (stopped()) {
          scheduler_.abort(EndReason::stopped);
          break;
        }
        if (!take_batch(worker)) {
          ++idle_;
          work_.wait(lock);
          --idle_;
          continue;
        }
        if (idle_ > 0 && scheduler_.has_work()) work_.notify_one();
        const bool report = w == 0 && options_.on_progress && step % 16 == 0;
        const SearchProgress progress = report ? scheduler_.progress() : SearchProgress{};
        lock.unlock();
        if (report) options_.on_progress(progress);
        perform_batch(worker, lock);
      }
    } catch (...) {
      if (!lock) lock.lock();
      if (!error_) error_ = std::current_exception();
      scheduler_.abort(EndReason::stopped);
    }
    work_.notify_all();
  }

  /// Locked. False: there is nothing to do for now. What the order waits for is taken alone: its outcome decides.
  bool take_batch(Worker& worker) {
    worker.jobs.clear();
    worker.finished.clear();
    worker.handed_in = 0;
    const double fitting = std::clamp(kBatchSeconds / worker.seconds_per_job, 1.0, 1.0 * kMaxBatch);
    const auto size = static_cast<std::size_t>(fitting);
    while (worker.jobs.size() < size && (worker.jobs.empty() || !worker.jobs.back().head)) {
      const auto job = scheduler_.take(worker.slot(worker.jobs.size()), now());
      if (!job) break;
      worker.jobs.push_back(*job);
    }
    return !worker.jobs.empty();
  }

  /// Begins unlocked, ends locked with everything handed in or given back.
  void perform_batch(Worker& worker, std::unique_lock<std::mutex>& lock) {
    const auto begun = StopSource::Clock::now();
    while (worker.finished.size() < worker.jobs.size()) {
      const std::size_t i = worker.finished.size();
      worker.finished.push_back(perform(worker, worker.slot(i), worker.jobs[i]));
      if (!awaited(worker)) continue;
      if (i + 1 == worker.jobs.size()) break;
      lock.lock();
      hand_in(worker);
      if (scheduler_.head_waits()) break;
      lock.unlock();
    }
    const double spent = std::chrono::duration<double>(StopSource::Clock::now() - begun).count();
    const double each = std::max(1e-7, spent / static_cast<double>(worker.finished.size()));
    worker.seconds_per_job += 0.2 * (each - worker.seconds_per_job);
    if (!lock) lock.lock();
    hand_in(worker);
    while (worker.jobs.size() > worker.finished.size()) {
      worker.jobs.pop_back();
      scheduler_.give_back(worker.slot(worker.jobs.size()));
    }
  }
  bool awaited(const Worker& worker) const {
    for (std::size_t k = worker.handed_in; k < worker.jobs.size(); ++k) {
      if (scheduler_.awaited(worker.slot(k))) return true;
    }
    return false;
  }
  /// Locked.
  void hand_in(Worker& worker) {
    for (; worker.handed_in < worker.finished.size(); ++worker.handed_in) {
      scheduler_.finish(worker.slot(worker.handed_in), std::move(worker.finished[worker.handed_in]), now());
    }
  }

  /// Unlocked.
  typename Sched::Finished perform(Worker& worker, int slot, const typename Sched::Job& job) {
    Context& context = contexts_[static_cast<std::size_t>(worker.index)];
    const std::atomic<bool>* cancel = scheduler_.cancel_flag(slot);
    typename Sched::Finished finished;
    if (cancel->load(std::memory_order_relaxed)) {  // in a batch, before its turn came
      finished.outcome.report.cancelled = true;
      return finished;
    }
    const double begun = measured_ ? thread_cpu_s() : 0;
    if (!job.generates()) {
      try {
        const auto evaluated = domain_.evaluate(context, table_.state(job.need.parent), job.need.action, cancel);
        finished.outcome.report = evaluated;
        if (measured_) finished.seconds = thread_cpu_s() - begun;
        if (evaluated.cancelled || !evaluated.valid) return finished;
        finished.outcome.child = table_.intern(evaluated.child, worker.writer);
      } catch (...) {
        finished.error = std::current_exception();
        return finished;
      }
      if (!Sched::Order::kLazy) return finished;
    }
    const StateId state = job.generates() ? job.need.parent : finished.outcome.child;
    if (table_.expanded(state) || table_.closed_by(state) != kNoState) return finished;
    try {
      finished.expansion = expand_state(worker, state);
    } catch (...) {
      finished.expansion_error = std::current_exception();
    }
    return finished;
  }

  std::unique_ptr<Expansion> expand_state(Worker& worker, StateId state) {
    return expand(domain_, contexts_[static_cast<std::size_t>(worker.index)], table_, worker.writer, worker.edges,
                  state, scheduler_.weight(), Sched::Order::kLazy);
  }
  bool stopped() const { return options_.stop && options_.stop->stopped(); }
  double now() const {
    if (!parallel_.trace) return 0;
    return std::chrono::duration<double>(StopSource::Clock::now() - begun_).count();
  }

  void complete_trace(Trace& trace, StateId start) {
    trace.weight = scheduler_.weight().value();
    trace.lazy = Sched::Order::kLazy;
    trace.threads = static_cast<int>(contexts_.size());
    trace.schedule = to_string(parallel_.schedule);
    trace.wall_s = now();
    trace.start = start.value;
    std::vector<bool> met(table_.id_bound(), false);  // ids are not dense
    met[start.index()] = true;
    for (const TraceJob& job : trace.jobs) {
      if (job.child >= 0) met[static_cast<std::size_t>(job.child)] = true;
    }
    for (std::size_t i = 0; i < met.size(); ++i) {
      const StateId id(i);
      const Expansion* expansion = scheduler_.expansion(id);
      if (!met[i] && !expansion) continue;
      const auto& state = table_.state(id);
      TraceState record{id.value, table_.class_of(id).value, domain_.is_goal(state), domain_.heuristic(state), {}};
      for (std::size_t k = 0; expansion && k < expansion->edges.size(); ++k) {
        const LazyEdge& edge = expansion->edges[k];
        record.edges.push_back({edge.cost, edge.heuristic, expansion->cells[k].known.value});
      }
      trace.states.push_back(std::move(record));
    }
  }

  const D& domain_;
  std::span<Context> contexts_;
  const SearchOptions& options_;
  const ParallelOptions& parallel_;
  const bool measured_;
  StateTable<D> table_;
  std::mutex mutex_;  // guards the three below
  Sched scheduler_;
  std::exception_ptr error_;
  int idle_ = 0;
  std::condition_variable work_;  // something may be taken, or all is over
  StopSource::Clock::time_point begun_;
};

/// Runs Order with one worker per context. With one context (and nothing to measure) this is serial_search().
template <template <class, class> class OrderT, Domain D>
SearchResult<typename D::State> parallel_search(const D& domain, std::span<typename D::Context> contexts,
                                                const SearchOptions& options, const ParallelOptions& parallel,
                                                ParallelStats* stats = nullptr) {
  if (contexts.empty()) throw std::invalid_argument("a search needs at least one context");
  if (contexts.size() == 1 && !parallel.trace && !parallel.measure) {
    auto result = serial_search<OrderT>(domain, contexts[0], options);
    if (stats) {
      *stats = {};
      stats->evaluations = stats->used = stats->heads = result.counters.evaluations;
      stats->charge = result.counters.charge;
    }
    return result;
  }
  ParallelSearch<OrderT, D> search(domain, contexts, options, parallel);
  auto result = search.run();
  if (stats) *stats = search.stats();
  return result;
}

/// Lazy weighted A* (LazyOrder).
template <Domain D>
SearchResult<typename D::State> parallel_lazy_weighted_astar(const D& domain, std::span<typename D::Context> contexts,
                                                             const SearchOptions& options,
                                                             const ParallelOptions& parallel = {},
                                                             ParallelStats* stats = nullptr) {
  return parallel_search<LazyOrder>(domain, contexts, options, parallel, stats);
}

/// Weighted A* (EagerOrder): the outgoing edges of a state are the jobs.
template <Domain D>
SearchResult<typename D::State> parallel_weighted_astar(const D& domain, std::span<typename D::Context> contexts,
                                                        const SearchOptions& options,
                                                        const ParallelOptions& parallel = {},
                                                        ParallelStats* stats = nullptr) {
  return parallel_search<EagerOrder>(domain, contexts, options, parallel, stats);
}

}  // namespace mamo::search
