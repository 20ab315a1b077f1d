// The parallel search on the real domain: one result whatever the threads, prompt stops, no memory left behind.
#include <gtest/gtest.h>

#include <thread>

#include "support/planned.hpp"

namespace mamo {
namespace {

using fixtures::kSanitized;
using fixtures::long_run;
using fixtures::planned;
using fixtures::tabletop;

/// Limits count committed work, so the runs that they cut are compared like the others.
PlanOptions limited(std::int64_t simulations, std::int64_t expansions) {
  PlanOptions options;
  options.max_simulations = simulations;
  options.max_expansions = expansions;
  return options;
}

/// What of a result may not depend on threads.
void expect_same(const PlanResult& a, const PlanResult& b) {
  EXPECT_EQ(a.signature, b.signature);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.stats.simulations_used, b.stats.simulations_used);
  EXPECT_EQ(a.stats.tracking_simulations, b.stats.tracking_simulations);
  EXPECT_EQ(a.stats.expansions, b.stats.expansions);
  EXPECT_EQ(a.stats.collision_checks, b.stats.collision_checks);
  EXPECT_EQ(a.stats.planning_iterations, b.stats.planning_iterations);
  EXPECT_EQ(a.stats.relevant_objects, b.stats.relevant_objects);
  EXPECT_EQ(a.stats.failures, b.stats.failures);
}

TEST(PlansOnThreads, AreTheSerialPlanForEveryNumberOfThreadsAndBatch) {
  const int problems = long_run() ? 30 : 4;
  for (int index = 0; index < problems && !HasFailure(); ++index) {
    const Problem problem = tabletop(8 + index % 9, index % 4, 11, index);
    const std::string planner = index % 3 == 2 ? "fullsim" : "selsim";
    PlanOptions options = limited(150, 400);
    options.weight = index % 2 ? 10 : 0;
    const PlanResult serial = planned(problem, planner, options);
    for (const int threads : {1, 2, 3, 8})
      for (const int batch : {1, 4, 16}) {
        options.threads = threads;
        options.batch = batch;
        SCOPED_TRACE(testing::Message() << problem.name << ", " << planner << ", " << threads << " threads, batch "
                                        << batch);
        expect_same(serial, planned(problem, planner, options));
      }
  }
}

TEST(PlansOnThreads, AreTheSameWithoutTheMemoWhichOnlySavesSimulations) {
  std::int64_t with = 0, without = 0;
  for (int index = 0; index < (long_run() ? 30 : 5); ++index) {
    const Problem problem = tabletop(8 + index % 9, index % 4, 11, index);
    for (const char* contact_cost : {"0", "2"}) {
      PlanOptions options = limited(1000000, 300);
      options.set = {{"contact_cost", contact_cost}};
      const PlanResult a = planned(problem, "selsim", options);
      options.set["memo"] = "false";
      options.threads = 1 + index % 3;
      const PlanResult b = planned(problem, "selsim", options);
      EXPECT_EQ(a.signature, b.signature) << problem.name;
      EXPECT_EQ(a.cost, b.cost);
      EXPECT_EQ(a.stats.failures, b.stats.failures);
      EXPECT_EQ(a.stats.collision_checks, b.stats.collision_checks);
      EXPECT_LE(a.stats.simulations_used, b.stats.simulations_used) << problem.name;
      with += a.stats.simulations_used + a.stats.tracking_simulations;
      without += b.stats.simulations_used + b.stats.tracking_simulations;
    }
  }
  EXPECT_LT(with, without);
}

TEST(PlansOnThreads, LeaveNoMemoryBehind) {
  if (kSanitized) GTEST_SKIP() << "sanitizers keep freed memory";
  const int plans = long_run() ? 500 : 40;
  std::vector<Problem> problems;
  for (int index = 0; index < 10; ++index) problems.push_back(tabletop(12, 2, 12, index));
  long warm = 0;
  for (int k = 0; k < plans; ++k) {
    PlanOptions options = limited(40, 100);
    options.threads = 8;
    options.seed = static_cast<std::uint64_t>(k / 10);
    const auto& problem = problems[static_cast<std::size_t>(k % 10)];
    planned(problem, k % 2 ? "selsim" : "fullsim", options);
    if (k == plans / 2 - 1) warm = fixtures::resident_kb();
  }
  EXPECT_LT(fixtures::resident_kb() - warm, 4096) << "kB grown in the second half of " << plans << " plans";
}

/// A search that goes on for seconds: low weight, every object simulated.
struct LongSearch {
  Problem problem = tabletop(16, 4, 5, 6);
  PlanOptions options;
  LongSearch(const std::string& schedule, int threads) {
    options.weight = 10;
    options.schedule = schedule;
    options.threads = threads;
  }
};

/// The shortest of several delays: what a busy machine adds is not ours.
template <class Delay>
double least(Delay delay) {
  double best = 1e9;
  for (int attempt = 0; attempt < 5 && best > 0.05; ++attempt) best = std::min(best, delay());
  return best;
}

TEST(PlansOnThreads, ObeyADeadlineWithinFiftyMilliseconds) {
  if (kSanitized) GTEST_SKIP() << "ten times slower";
  for (const char* schedule : {"runahead", "window", "batch"})
    for (const int threads : {1, 2, 8}) {
      const LongSearch search(schedule, threads);
      EXPECT_LT(least([&] {
                  StopSource stop(0.25);
                  const auto begun = StopSource::Clock::now();
                  const PlanResult result = planned(search.problem, "fullsim", search.options, stop);
                  EXPECT_EQ(result.status, PlanStatus::timeout);
                  return std::chrono::duration<double>(StopSource::Clock::now() - begun).count() - 0.25;
                }),
                0.05)
          << schedule << ", " << threads << " threads";
    }
}

TEST(PlansOnThreads, ObeyAnInterruptWithinFiftyMilliseconds) {
  if (kSanitized) GTEST_SKIP() << "ten times slower";
  for (const int threads : {1, 2, 8}) {
    const LongSearch search("runahead", threads);
    EXPECT_LT(least([&] {
                StopSource stop;
                StopSource::Clock::time_point asked;
                std::jthread interrupter([&] {
                  std::this_thread::sleep_for(std::chrono::milliseconds(250));
                  asked = StopSource::Clock::now();
                  stop.request(StopReason::interrupted);
                });
                const PlanResult result = planned(search.problem, "fullsim", search.options, stop);
                const auto returned = StopSource::Clock::now();
                interrupter.join();
                EXPECT_EQ(result.status, PlanStatus::interrupted);
                EXPECT_TRUE(result.plan.empty());
                return std::chrono::duration<double>(returned - asked).count();
              }),
              0.05)
        << threads << " threads";
  }
}

}  // namespace
}  // namespace mamo
