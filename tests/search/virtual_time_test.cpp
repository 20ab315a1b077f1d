// Virtual time: the scheduler's own answers, bounds that no schedule may break, and a trace as a domain.
#include "mamo/search/virtual_time.hpp"

#include <gtest/gtest.h>

#include "support/toy_graphs.hpp"

#include "mamo/search/eager_order.hpp"
#include "mamo/search/lazy_order.hpp"
#include "mamo/search/parallel_search.hpp"
#include "mamo/search/toy_clutter.hpp"
#include "mamo/search/trace_domain.hpp"

namespace mamo::search {
namespace {

ToyClutterOptions clutter(std::uint64_t seed) {
  ToyClutterOptions o;
  o.seed = seed;
  o.side = 30;
  o.walls = 12;
  o.wall_radius = 8;
  o.movables = 20;
  o.movable_radius = 6;
  return o;
}

TEST(VirtualTime, NoScheduleBeatsWorkOverWorkersOrIsSlowerThanSerial) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ToyClutter domain(clutter(seed));
    SearchOptions options;
    options.weight = 3;
    options.max_evaluations = 4000;
    const auto seconds = [&](const ToyState& s, std::int32_t a) { return 1e-3 * domain.evaluation_ms(s, a); };
    const WorkAndSpan work = work_and_span<LazyOrder>(domain, options, seconds);
    if (work.commits.size() < 100) continue;
    ToyClutter::Context context;
    const std::uint64_t order_hash = serial_search<LazyOrder>(domain, context, options).order_hash;
    EXPECT_NEAR(clairvoyant_s(work, 1), work.work_s, 1e-6);
    for (const int p : {1, 2, 5, 16}) {
      EXPECT_GE(clairvoyant_s(work, p), std::max(work.work_s / p, work.span_s) - 1e-9);
      for (const Schedule schedule : {Schedule::batch, Schedule::window, Schedule::runahead}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << " workers " << p << " " << to_string(schedule));
        ParallelOptions parallel;
        parallel.schedule = schedule;
        const VirtualRun run = virtual_search<LazyOrder>(domain, seconds, options, parallel, p);
        EXPECT_EQ(run.order_hash, order_hash);
        EXPECT_GE(run.seconds, work.work_s / p - 1e-9);
        EXPECT_LE(run.seconds, 1.02 * work.work_s + 1e-5 * static_cast<double>(run.stats.evaluations));
        EXPECT_NEAR(run.used_s, work.work_s, 1e-3 * work.work_s);
        EXPECT_LE(run.efficiency(), 1 + 1e-6);
        EXPECT_NEAR(run.idle_s + run.busy_s, p * run.seconds, 1e-6);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(VirtualTime, RunaheadIsNearTheClairvoyantScheduleAndWastesLittleOnTwoWorkers) {
  double work_s = 0, run_s = 0, clairvoyant = 0, busy = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ToyClutter domain(clutter(seed));
    SearchOptions options;
    options.weight = 3;
    options.max_evaluations = 3000;
    const auto seconds = [&](const ToyState& s, std::int32_t a) { return 1e-3 * domain.evaluation_ms(s, a); };
    const WorkAndSpan work = work_and_span<LazyOrder>(domain, options, seconds);
    if (work.work_s < 3) continue;
    const VirtualRun run = virtual_search<LazyOrder>(domain, seconds, options, {}, 2);
    work_s += work.work_s;
    run_s += run.seconds;
    busy += run.busy_s;
    clairvoyant += clairvoyant_s(work, 2);
  }
  EXPECT_GT(work_s / run_s, 1.8);
  EXPECT_GT(clairvoyant / run_s, 0.85);
  EXPECT_GT(work_s / busy, 0.9);
}

template <template <class, class> class OrderT>
void expect_trace_repeats(std::uint64_t seed) {
  const RandomGraph domain(random_toy(seed));
  SearchOptions options;
  options.weight = random_weight(seed);
  std::vector<RandomGraph::Context> contexts(3);
  Trace trace;
  ParallelOptions parallel;
  parallel.trace = &trace;
  const auto result = parallel_search<OrderT, RandomGraph>(domain, contexts, options, parallel);
  const TraceDomain recorded(trace);
  SearchOptions again = options;
  again.max_evaluations = recorded.commits();
  TraceDomain::Context context;
  const auto repeated = serial_search<OrderT>(recorded, context, again);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  EXPECT_EQ(repeated.counters.evaluations, result.counters.evaluations);
  EXPECT_EQ(repeated.counters.valid, result.counters.valid);
  EXPECT_EQ(repeated.counters.expansions, result.counters.expansions);
  EXPECT_EQ(repeated.counters.charge, result.counters.charge);
  EXPECT_EQ(repeated.cost, result.cost);
  EXPECT_EQ(repeated.found(), result.found());
  const auto seconds = [&](const TraceDomain::State& s, std::int32_t a) { return 1e-4 + recorded.seconds(s, a); };
  for (const int p : {2, 7}) {
    const VirtualRun run = virtual_search<OrderT>(recorded, seconds, again, {}, p);
    EXPECT_EQ(run.order_hash, repeated.order_hash);
  }
}

TEST(TraceDomain, RepeatsTheRecordedSearch) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    expect_trace_repeats<LazyOrder>(seed);
    expect_trace_repeats<EagerOrder>(seed);
  }
}

}  // namespace
}  // namespace mamo::search
