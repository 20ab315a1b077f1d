// The scheduler under random interleavings of virtual workers, on one thread: always the serial search.
#include "mamo/search/scheduler.hpp"

#include <gtest/gtest.h>

#include "support/interleaving.hpp"
#include "support/same_result.hpp"
#include "support/toy_graphs.hpp"

#include "mamo/search/lazy_weighted_astar.hpp"
#include "mamo/search/weighted_astar.hpp"

namespace mamo::search {
namespace {

template <template <class, class> class OrderT>
void expect_serial_under_interleavings(std::uint64_t seed) {
  RandomStream random(seed, {0x74657374});
  const RandomGraphOptions graph = random_toy(seed);
  const RandomGraph domain(graph);
  SearchOptions options;
  options.weight = random_weight(seed);
  if (random.below(4) == 0) options.max_evaluations = static_cast<std::int64_t>(random.below(60));
  if (random.below(4) == 0) options.max_expansions = static_cast<std::int64_t>(random.below(20));
  if (random.below(4) == 0) options.max_charge = static_cast<std::int64_t>(random.below(10));
  RandomGraph::Context context;
  const auto serial = serial_search<OrderT>(domain, context, options);
  for (const Schedule schedule : {Schedule::batch, Schedule::window, Schedule::runahead}) {
    constexpr int kBatches[] = {0, 0, 1, 2, 4, 16, 64};
    constexpr int kWorkers[] = {1, 2, 3, 4, 8, 16};
    ParallelOptions parallel;
    parallel.schedule = schedule;
    parallel.batch = kBatches[random.below(7)];
    Interleaving how;
    how.workers = kWorkers[random.below(6)];
    how.seed = seed;
    how.slow_head = random.below(2) ? 0.9 : 0.0;
    how.fickle = random.below(3) == 0;
    SCOPED_TRACE(testing::Message() << "seed " << seed << " " << to_string(schedule) << " batch " << parallel.batch
                                    << " workers " << how.workers);
    ParallelStats stats;
    expect_same(serial, run_interleaved<OrderT>(domain, options, parallel, how, &stats));
    EXPECT_EQ(stats.used, serial.counters.evaluations);
    EXPECT_GE(stats.evaluations, stats.used);
    if (how.workers == 1) {
      EXPECT_EQ(stats.evaluations, stats.used) << "one worker evaluates what is needed and no more";
    }
  }
}

TEST(Scheduler, LazyIsSerialUnderAnyInterleaving) {
  for (std::uint64_t seed = 1; seed <= 3000 && !testing::Test::HasFailure(); ++seed) {
    expect_serial_under_interleavings<LazyOrder>(seed);
  }
}

TEST(Scheduler, EagerIsSerialUnderAnyInterleaving) {
  for (std::uint64_t seed = 1; seed <= 3000 && !testing::Test::HasFailure(); ++seed) {
    expect_serial_under_interleavings<EagerOrder>(seed);
  }
}

}  // namespace
}  // namespace mamo::search
