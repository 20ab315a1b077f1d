// The real scheduler with imaginary workers: what P workers would need, on a machine that has fewer.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "mamo/search/scheduler.hpp"
#include "mamo/search/serial_search.hpp"

namespace mamo::search {

/// Seconds of everything that is not an evaluation.
struct VirtualCosts {
  double locked_s = 1e-6;  // one take or finish, commits included; nobody else may at the same time
  double cancel_s = 1e-3;  // from the flag to the return of a cancelled evaluation
};

struct VirtualRun {
  double seconds = 0;  // from begin to the end of the search
  double busy_s = 0;   // evaluations, cancelled ones included, summed over workers
  double used_s = 0;   // of it: committed
  double stall_s = 0;  // the order waited for an evaluation
  double idle_s = 0;   // workers without an evaluation, summed
  ParallelStats stats;
  std::uint64_t order_hash = 0;
  double efficiency() const { return busy_s > 0 ? used_s / busy_s : 1; }
};

/// Work and span of the serial search: sum of the committed evaluations, and the heaviest chain of them in which each
/// begins at the state that the one before led to. No schedule that keeps the serial order takes less than work / P.
/// Span bounds those that learn of a state by the edge that closed it; runahead may have met it earlier by another.
struct WorkAndSpan {
  struct Commit {
    std::int32_t parent = -1;  // commit that led to the edge's state; -1: the start
    double seconds = 0;
  };
  std::vector<Commit> commits;
  double work_s = 0, span_s = 0;
};

/// Greedy schedule with foresight: only committed evaluations, ready when their parent is done, earliest commit first.
double clairvoyant_s(const WorkAndSpan& work, int workers);

/// seconds(state, action): what the evaluation takes. It must not depend on anything else.
template <template <class, class> class OrderT, Domain D, class Seconds>
WorkAndSpan work_and_span(const D& domain, const SearchOptions& options, Seconds seconds) {
  StateTable<D> table(domain);
  OrderT<D, StateTable<D>> order(domain, table, options);
  typename D::Context context{};
  SerialHost<D> host(domain, context, table);
  WorkAndSpan result;
  std::vector<std::int32_t> born;  // by state id: the commit that first led there
  std::vector<double> chain;       // by commit
  order.begin(table.intern(domain.start()), host);
  while (const Need* need = order.next(host)) {
    const auto evaluated = domain.evaluate(context, table.state(need->parent), need->action, nullptr);
    const double s = seconds(table.state(need->parent), need->action);
    const StateId child = evaluated.valid ? table.intern(evaluated.child) : kNoState;
    born.resize(table.id_bound(), -1);
    const std::int32_t parent = born[need->parent.index()];
    result.commits.push_back({parent, s});
    chain.push_back(s + (parent < 0 ? 0 : chain[static_cast<std::size_t>(parent)]));
    result.work_s += s;
    result.span_s = std::max(result.span_s, chain.back());
    order.commit({evaluated, child}, host);
    if (child != kNoState && born[child.index()] < 0) born[child.index()] = static_cast<std::int32_t>(chain.size()) - 1;
  }
  return result;
}

/// Runs Scheduler in virtual time: a worker that takes a job returns it seconds(state, action) later.
template <template <class, class> class OrderT, Domain D, class Seconds>
class VirtualSearch {
 public:
  VirtualSearch(const D& domain, Seconds seconds, const SearchOptions& options, const ParallelOptions& parallel,
                int workers, const VirtualCosts& costs = {})
      : domain_(domain),
        seconds_(seconds),
        costs_(costs),
        parallel_(parallel),
        table_(domain),
        scheduler_(domain, table_, options, parallel_, workers),
        workers_(static_cast<std::size_t>(workers)) {
    parallel_.trace = &trace_;
  }

  VirtualRun run() {
    const StateId start = table_.intern(domain_.start());
    scheduler_.begin(start, Sched::Order::kLazy ? expand_state(start) : nullptr);
    give_out();
    while (!scheduler_.ended()) {
      const auto next = std::min_element(workers_.begin(), workers_.end(),
                                         [](const Worker& a, const Worker& b) { return a.until < b.until; });
      hand_in(*next);
      give_out();
    }
    run_.seconds = clock_;
    for (const Worker& w : workers_) {
      if (w.until < kNever) run_.busy_s += std::max(0.0, clock_ - w.begun);
    }
    run_.idle_s = static_cast<double>(workers_.size()) * clock_ - run_.busy_s;
    run_.stats = scheduler_.stats();
    run_.used_s = run_.stats.used_s;
    run_.order_hash = scheduler_.result().order_hash;
    for (const TraceJob& job : trace_.jobs) {
      if (job.commit >= 0) run_.stall_s += std::max(0.0, job.done - job.needed);
    }
    return run_;
  }

 private:
  using Sched = Scheduler<OrderT, D>;
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Worker {
    typename Sched::Job job;
    double begun = 0, until = kNever;
    bool cancelled = false;
  };

  int index(const Worker& w) const { return static_cast<int>(&w - workers_.data()); }
  std::unique_ptr<Expansion> expand_state(StateId state) {
    return expand(domain_, context_, table_, writer_, edges_, state, scheduler_.weight(), Sched::Order::kLazy);
  }

  /// Lets all idle workers take what they can, then shortens what has been cancelled.
  void give_out() {
    for (Worker& w : workers_) {
      if (w.until < kNever || scheduler_.ended()) continue;
      const auto job = scheduler_.take(index(w), clock_);
      if (!job) break;
      clock_ += costs_.locked_s;
      w = {*job, clock_, clock_, false};
      if (!job->generates()) w.until += seconds_(table_.state(job->need.parent), job->need.action);
    }
    for (Worker& w : workers_) {
      if (w.until == kNever || w.cancelled || !scheduler_.cancel_flag(index(w))->load()) continue;
      if (clock_ + costs_.cancel_s >= w.until) continue;
      w.until = clock_ + costs_.cancel_s;
      w.cancelled = true;
    }
  }

  void hand_in(Worker& w) {
    if (const double wait = w.until - clock_; wait > 0) clock_ = w.until;
    clock_ += costs_.locked_s;
    run_.busy_s += w.until - w.begun;
    typename Sched::Finished finished;
    finished.seconds = w.until - w.begun;
    StateId state = w.job.need.parent;
    if (w.cancelled) {
      finished.outcome.report.cancelled = true;
    } else if (!w.job.generates()) {
      const auto evaluated = domain_.evaluate(context_, table_.state(state), w.job.need.action, nullptr);
      finished.outcome.report = evaluated;
      state = kNoState;
      if (evaluated.valid) finished.outcome.child = table_.intern(evaluated.child, writer_);
      if (Sched::Order::kLazy) state = finished.outcome.child;
    }
    if (!w.cancelled && state != kNoState && !table_.expanded(state) && table_.closed_by(state) == kNoState) {
      finished.expansion = expand_state(state);
    }
    w.until = kNever;
    scheduler_.finish(index(w), std::move(finished), clock_);
  }

  const D& domain_;
  Seconds seconds_;
  VirtualCosts costs_;
  Trace trace_;
  ParallelOptions parallel_;
  StateTable<D> table_;
  Sched scheduler_;
  std::vector<Worker> workers_;
  typename D::Context context_{};
  typename StateTable<D>::Writer writer_;
  std::vector<LazyEdge> edges_;  // scratch
  double clock_ = 0;
  VirtualRun run_;
};

template <template <class, class> class OrderT, Domain D, class Seconds>
VirtualRun virtual_search(const D& domain, Seconds seconds, const SearchOptions& options,
                          const ParallelOptions& parallel, int workers, const VirtualCosts& costs = {}) {
  return VirtualSearch<OrderT, D, Seconds>(domain, seconds, options, parallel, workers, costs).run();
}

}  // namespace mamo::search
