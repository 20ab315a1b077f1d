// Real threads: every schedule, number of threads and batch gives the serial search; stops, exceptions, cancellation.
#include "mamo/search/parallel_search.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "support/same_result.hpp"
#include "support/toy_graphs.hpp"

namespace mamo::search {
namespace {

using Result = SearchResult<ToyState>;
using Contexts = std::vector<RandomGraph::Context>;

/// tools/check --long sets it: 20 repeats with random delays, each with its own, and 64 threads.
bool long_run() { return std::getenv("MAMO_LONG") != nullptr; }

constexpr Schedule kSchedules[] = {Schedule::batch, Schedule::window, Schedule::runahead};

Contexts contexts(int threads, std::uint64_t jitter = 0) {
  Contexts all(static_cast<std::size_t>(threads));
  for (std::size_t i = 0; i < all.size(); ++i) all[i].jitter = jitter ? mix64(jitter + i) | 1 : 0;
  return all;
}

template <template <class, class> class OrderT>
void expect_serial_on_threads(std::uint64_t seed, int threads, std::uint64_t jitter, Executor& executor) {
  RandomStream random(seed, {0x70617261});
  const RandomGraph domain(random_toy(seed));
  SearchOptions options;
  options.weight = random_weight(seed);
  if (random.below(5) == 0) options.max_evaluations = static_cast<std::int64_t>(random.below(60));
  RandomGraph::Context context;
  const Result serial = serial_search<OrderT>(domain, context, options);
  for (const Schedule schedule : kSchedules) {
    constexpr int kBatches[] = {0, 0, 1, 4, 16, 64};
    ParallelOptions parallel;
    parallel.schedule = schedule;
    parallel.batch = kBatches[random.below(6)];
    parallel.executor = &executor;
    parallel.measure = true;  // the engine also with one thread
    SCOPED_TRACE(testing::Message() << "seed " << seed << " " << to_string(schedule) << " batch " << parallel.batch
                                    << " threads " << threads << " jitter " << jitter);
    Contexts all = contexts(threads, jitter);
    ParallelStats stats;
    expect_same(serial, parallel_search<OrderT, RandomGraph>(domain, all, options, parallel, &stats));
    EXPECT_EQ(stats.used, serial.counters.evaluations);
  }
}

class OnThreads : public testing::TestWithParam<int> {
 protected:
  /// 500 graphs as fast as they go, then 40 with random delays in the evaluations, again and again.
  template <template <class, class> class OrderT>
  void expect_serial_on_many() {
    Executor executor(GetParam());
    for (std::uint64_t seed = 1; seed <= 500 && !HasFailure(); ++seed) {
      expect_serial_on_threads<OrderT>(seed, GetParam(), 0, executor);
    }
    const std::uint64_t repeats = long_run() ? 20 : 1;
    for (std::uint64_t repeat = 1; repeat <= repeats; ++repeat) {
      for (std::uint64_t seed = 501; seed <= 540 && !HasFailure(); ++seed) {
        expect_serial_on_threads<OrderT>(seed, GetParam(), hash_combine(seed, repeat) | 1, executor);
      }
    }
  }
};

TEST_P(OnThreads, LazyIsSerial) { expect_serial_on_many<LazyOrder>(); }
TEST_P(OnThreads, EagerIsSerial) { expect_serial_on_many<EagerOrder>(); }

std::vector<int> thread_counts() {
  std::vector<int> counts{1, 2, 3, 4, 8, 16};
  if (long_run()) counts.push_back(64);
  return counts;
}
INSTANTIATE_TEST_SUITE_P(Threads, OnThreads, testing::ValuesIn(thread_counts()));

RandomGraphOptions long_graph() {
  RandomGraphOptions options;
  options.nodes = 3000;
  options.seed = 2;
  options.degree = 5;
  options.heuristic = 0;
  options.invalid = 0.1;
  return options;
}

TEST(ParallelSearch, StopsInTheMiddleWithAPrefixOfTheSerialSearch) {
  RandomGraphOptions graph = long_graph();
  RandomGraph::Context context;
  SearchOptions options;
  const RandomGraph quick(graph);
  const Result whole = serial_search<LazyOrder>(quick, context, options);
  ASSERT_GT(whole.counters.evaluations, 300);
  graph.delay = ToyDelay::sleep;
  graph.check_ms = 1;
  graph.physics_rate = 0;
  const RandomGraph domain(graph);
  for (const Schedule schedule : kSchedules) {
    Contexts all = contexts(4, 99);
    StopSource stop(0.02);
    options.stop = &stop;
    ParallelOptions parallel;
    parallel.schedule = schedule;
    const Result cut = parallel_lazy_weighted_astar(domain, std::span(all), options, parallel);
    ASSERT_EQ(cut.reason, EndReason::stopped);
    ASSERT_LT(cut.counters.evaluations, whole.counters.evaluations);
    SearchOptions limited;
    limited.max_evaluations = cut.counters.evaluations;
    const Result prefix = serial_search<LazyOrder>(domain, context, limited);
    EXPECT_EQ(prefix.counters.valid, cut.counters.valid);
    EXPECT_EQ(prefix.counters.charge, cut.counters.charge);
    EXPECT_EQ(prefix.counters.expansions, cut.counters.expansions);
  }
}

TEST(ParallelSearch, ObeysAStopWithinFiftyMilliseconds) {
  RandomGraphOptions graph = long_graph();
  graph.delay = ToyDelay::sleep;
  graph.physics_rate = 1;  // evaluations of up to 200 ms, which look at their flag every half millisecond
  graph.physics_ms = 100;
  const RandomGraph domain(graph);
  for (const Schedule schedule : kSchedules) {
    Contexts all = contexts(8);
    StopSource stop;
    SearchOptions options;
    options.stop = &stop;
    ParallelOptions parallel;
    parallel.schedule = schedule;
    for (RandomGraph::Context& context : all) context.stop = &stop;
    StopSource::Clock::time_point asked;
    std::jthread interrupter([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      asked = StopSource::Clock::now();
      stop.request(StopReason::interrupted);
    });
    const Result result = parallel_lazy_weighted_astar(domain, std::span(all), options, parallel);
    const auto returned = StopSource::Clock::now();
    interrupter.join();
    EXPECT_EQ(result.reason, EndReason::stopped);
    EXPECT_LT(std::chrono::duration<double>(returned - asked).count(), 0.05);
  }
}

TEST(ParallelSearch, CancelsSpeculationWhenTheGoalIsReached) {
  // Some edges take 200 ms, others 1; the goal is near.
  std::int64_t cancelled = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomGraphOptions graph;
    graph.seed = seed;
    graph.nodes = 30;
    graph.degree = 10;
    graph.invalid = 0;
    graph.delay = ToyDelay::sleep;
    graph.check_ms = 1;
    graph.physics_rate = 0.5;
    graph.physics_ms = 100;
    const RandomGraph domain(graph);
    Contexts all = contexts(4);
    SearchOptions options;
    options.weight = 3;
    ParallelStats stats;
    const Result result = parallel_lazy_weighted_astar(domain, std::span(all), options, {}, &stats);
    EXPECT_TRUE(result.found());
    EXPECT_EQ(stats.used, result.counters.evaluations);
    cancelled += stats.cancelled;
  }
  EXPECT_GT(cancelled, 0);
}

TEST(ParallelSearch, AnExceptionReachesTheCallerIfAndOnlyIfItsTurnComes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    RandomGraphOptions graph = random_toy(seed);
    graph.nodes = 60;
    graph.throw_at_node = static_cast<int>(RandomStream(seed, {}).below(60));
    const RandomGraph domain(graph);
    SearchOptions options;
    options.weight = 2;
    bool serial_threw = false;
    Result serial;
    try {
      RandomGraph::Context context;
      serial = serial_search<LazyOrder>(domain, context, options);
    } catch (const std::runtime_error&) {
      serial_threw = true;
    }
    for (const Schedule schedule : kSchedules) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " " << to_string(schedule));
      ParallelOptions parallel;
      parallel.schedule = schedule;
      Contexts all = contexts(4);
      if (serial_threw) {
        EXPECT_THROW(parallel_lazy_weighted_astar(domain, std::span(all), options, parallel), std::runtime_error);
      } else {
        expect_same(serial, parallel_lazy_weighted_astar(domain, std::span(all), options, parallel));
      }
    }
  }
}

TEST(ParallelSearch, OneContextIsTheSerialLoop) {
  const RandomGraph domain(long_graph());
  Contexts one = contexts(1);
  RandomGraph::Context context;
  expect_same(serial_search<LazyOrder>(domain, context, {}), parallel_lazy_weighted_astar(domain, std::span(one), {}));
  EXPECT_EQ(one[0].evaluations, context.evaluations);
  Contexts none;
  EXPECT_THROW(parallel_lazy_weighted_astar(domain, std::span(none), {}), std::invalid_argument);
  Executor three(3);
  ParallelOptions parallel;
  parallel.executor = &three;
  Contexts two = contexts(2);
  EXPECT_THROW(parallel_lazy_weighted_astar(domain, std::span(two), {}, parallel), std::invalid_argument);
}

long resident_kb() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4;
}

TEST(ParallelSearch, FiveHundredSearchesOnEightThreadsLeaveNoMemoryBehind) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep freed memory";
#endif
  RandomGraphOptions graph;
  graph.nodes = 400;
  graph.labels = 3;
  graph.heuristic = 0.5;
  Executor executor(8);
  ParallelOptions parallel;
  parallel.executor = &executor;
  long warm = 0;
  for (std::uint64_t i = 1; i <= 500; ++i) {
    graph.seed = i % 50;
    const RandomGraph domain(graph);
    Contexts all = contexts(8, i % 5 == 0 ? i : 0);
    parallel.schedule = kSchedules[i % 3];
    parallel_lazy_weighted_astar(domain, std::span(all), {}, parallel);
    if (i == 200) warm = resident_kb();
  }
  EXPECT_LT(resident_kb() - warm, 4096) << "kB grown since the 200th search";
}

TEST(ParallelSearch, ProgressComesOnTheCallersThread) {
  RandomGraphOptions graph = long_graph();
  graph.delay = ToyDelay::sleep;
  graph.check_ms = 0.5;
  graph.physics_rate = 0;
  const RandomGraph domain(graph);
  Contexts all = contexts(3);
  SearchOptions options;
  options.max_evaluations = 100;
  const auto caller = std::this_thread::get_id();
  int calls = 0;
  options.on_progress = [&](const SearchProgress&) {
    ASSERT_EQ(std::this_thread::get_id(), caller);
    ++calls;
  };
  parallel_lazy_weighted_astar(domain, std::span(all), options);
  EXPECT_GT(calls, 0);
}

TEST(ParallelSearch, TraceAccountsForEveryEvaluationAndCanBeReadBack) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const RandomGraph domain(random_toy(seed));
    Contexts all = contexts(4);
    Trace trace;
    ParallelOptions parallel;
    parallel.trace = &trace;
    ParallelStats stats;
    const Result result = parallel_lazy_weighted_astar(domain, std::span(all), {}, parallel, &stats);
    std::int64_t used = 0, begun = 0;
    for (const TraceJob& job : trace.jobs) {
      begun += job.done >= 0;
      used += job.commit >= 0;
      if (job.commit >= 0) {
        EXPECT_GE(job.needed, 0);
        EXPECT_GE(job.committed, job.done);
      }
    }
    EXPECT_EQ(used, result.counters.evaluations);
    EXPECT_EQ(begun, stats.evaluations);
    std::stringstream file;
    write_trace(trace, file);
    const auto read = read_trace(file, "trace");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->jobs.size(), trace.jobs.size());
    EXPECT_EQ(read->states.size(), trace.states.size());
    std::stringstream again, once;
    write_trace(*read, again);
    write_trace(trace, once);
    EXPECT_EQ(again.str().size(), once.str().size());
  }
  std::istringstream bad("mamo-trace/1 1 1 1 x 0 0 2 0\nS 1 1 0 0 1 5\n");
  const auto read = read_trace(bad, "t.txt");
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().message, "t.txt:2: not a trace, expected a state");
}

TEST(Executor, RunsEveryWorkerOnceAndRethrows) {
  for (const int workers : {1, 2, 5}) {
    Executor executor(workers);
    std::vector<int> calls(static_cast<std::size_t>(workers));
    const auto caller = std::this_thread::get_id();
    bool first_on_caller = false;
    executor.run([&](WorkerId w) {
      ++calls[w.index()];
      if (w.value == 0) first_on_caller = std::this_thread::get_id() == caller;
    });
    EXPECT_EQ(calls, std::vector<int>(static_cast<std::size_t>(workers), 1));
    EXPECT_TRUE(first_on_caller);
    EXPECT_THROW(executor.run([&](WorkerId w) {
      if (w.value == workers - 1) throw std::runtime_error("last");
    }),
                 std::runtime_error);
  }
  EXPECT_THROW(Executor(0), std::invalid_argument);
}

}  // namespace
}  // namespace mamo::search
