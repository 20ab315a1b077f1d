// Signals and the memory limit, on work that heeds them and on work that does not. The tool is no library: its source
// file is part of this test.
#include "../../tools/mamo/interrupts.cpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace mamo::tool {
namespace {

using std::chrono::steady_clock;

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

TEST(SignalGuardTest, ASignalIsAStopRequestAndWorkThatHeedsItGoesOn) {
  StopSource stop;
  {
    const SignalGuard guard(stop);
    std::raise(SIGTERM);
    EXPECT_TRUE(stop.stopped());
  }
  EXPECT_EQ(stop.reason(), StopReason::interrupted);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // the grace timer died with the guard
}

TEST(SignalGuardDeathTest, WorkThatHeedsNothingEndsWithinASecondWithItsLastWords) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto start = steady_clock::now();
  EXPECT_EXIT(
      {
        StopSource stop;
        SignalGuard guard(stop);
        guard.set_last_words("{}\n");
        std::raise(SIGINT);
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
      },
      testing::ExitedWithCode(1), "mamo: interrupted");
  EXPECT_LT(seconds_since(start), 5.0);  // 0.9 s of grace, and the start of the child on a busy machine
}

TEST(MemoryGuardTest, RequestsAStopBeyondTheLimitAndNotBelowIt) {
  StopSource generous, tight;
  const MemoryGuard far(generous, 1 << 20);
  const MemoryGuard near(tight, 1);
  const auto start = steady_clock::now();
  while (!tight.stopped() && seconds_since(start) < 10) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(tight.reason(), StopReason::memory);
  EXPECT_EQ(generous.reason(), StopReason::none);
}

TEST(MemoryGuardTest, NoLimitStartsNoThreadAndStopsNothing) {
  StopSource stop;
  const MemoryGuard none(stop, 0);
  EXPECT_FALSE(stop.stopped());
  EXPECT_GT(peak_memory_mb(), 1.0);
}

}  // namespace
}  // namespace mamo::tool
