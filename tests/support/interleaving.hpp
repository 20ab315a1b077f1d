// Drives a Scheduler with virtual workers on one thread, in an order drawn at random: reaches interleavings that
// real threads seldom meet, and repeats them.
#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include "mamo/common/random.hpp"
#include "mamo/search/parallel_search.hpp"

namespace mamo::search {

struct Interleaving {
  int workers = 2;
  std::uint64_t seed = 1;
  bool fickle = false;   // jobs are given back now and then
  double slow_head = 0;  // chance that a worker with the needed edge is passed over ("slowest edge first")
};

template <template <class, class> class OrderT, Domain D>
SearchResult<typename D::State> run_interleaved(const D& domain, const SearchOptions& options,
                                                const ParallelOptions& parallel, const Interleaving& how,
                                                ParallelStats* stats = nullptr) {
  using Sched = Scheduler<OrderT, D>;
  StateTable<D> table(domain);
  Sched scheduler(domain, table, options, parallel, how.workers);
  typename D::Context context{};
  typename StateTable<D>::Writer writer;
  std::vector<LazyEdge> edges;
  const auto expand_state = [&](StateId s) {
    return expand(domain, context, table, writer, edges, s, scheduler.weight(), Sched::Order::kLazy);
  };
  const StateId start = table.intern(domain.start());
  scheduler.begin(start, Sched::Order::kLazy ? expand_state(start) : nullptr);

  struct Worker {
    std::optional<typename Sched::Job> job;
    typename Sched::Finished finished;
  };
  std::vector<Worker> workers(static_cast<std::size_t>(how.workers));
  RandomStream random(how.seed, {0x696e746c});
  while (!scheduler.ended()) {
    const std::size_t w = random.below(workers.size());
    Worker& worker = workers[w];
    if (!worker.job) {
      worker.job = scheduler.take(static_cast<int>(w));
      if (!worker.job) {
        bool busy = false;
        for (const Worker& other : workers) busy |= other.job.has_value();
        if (!busy) throw std::logic_error("nobody works and nobody may");
        continue;
      }
      // What a worker does unlocked happens here, at the take: as early as can be; the hints it reads are older.
      worker.finished = {};
      const Need& need = worker.job->need;
      if (!worker.job->generates()) {
        const auto evaluated = domain.evaluate(context, table.state(need.parent), need.action, nullptr);
        worker.finished.outcome.report = evaluated;
        if (evaluated.valid) worker.finished.outcome.child = table.intern(evaluated.child, writer);
      }
      const bool child = Sched::Order::kLazy && worker.finished.outcome.report.valid;
      const StateId state = worker.job->generates() ? need.parent : worker.finished.outcome.child;
      if ((child || worker.job->generates()) && !table.expanded(state) && table.closed_by(state) == kNoState) {
        worker.finished.expansion = expand_state(state);
      }
      continue;
    }
    if (worker.job->head && random.uniform() < how.slow_head) continue;
    if (how.fickle && random.below(8) == 0) {
      worker.job.reset();
      scheduler.give_back(static_cast<int>(w));
      continue;
    }
    if (scheduler.cancel_flag(static_cast<int>(w))->load() && random.below(2) == 0) {
      worker.finished = {};
      worker.finished.outcome.report.cancelled = true;
    }
    worker.job.reset();
    scheduler.finish(static_cast<int>(w), std::move(worker.finished));
  }
  if (stats) *stats = scheduler.stats();
  return scheduler.result();
}

}  // namespace mamo::search
