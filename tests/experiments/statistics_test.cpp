#include "mamo/experiments/statistics.hpp"

#include <cmath>
#include <limits>

namespace mamo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Record record(const std::string& problem, bool solved, double time_s, std::int64_t simulations = 1) {
  Record r;
  r.problem = problem;
  r.solved = r.found = solved;
  r.time_s = time_s;
  r.time_limit_s = 10;
  r.simulations = simulations;
  return r;
}

std::vector<const Record*> pointers(const std::vector<Record>& records) {
  std::vector<const Record*> all;
  for (const Record& r : records) all.push_back(&r);
  return all;
}

TEST(Percentile, IsTheNearestRank) {
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.25), 1);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.51), 3);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 1), 4);
  EXPECT_EQ(percentile({7}, 0.95), 7);
  EXPECT_EQ(percentile({1, 2, kInfinity, kInfinity}, 0.75), kInfinity);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(WilsonInterval, AgreesWithPublishedValues) {
  const auto [low, high] = wilson_interval(8, 10);
  EXPECT_NEAR(low, 0.4902, 1e-4);
  EXPECT_NEAR(high, 0.9433, 1e-4);
  EXPECT_LT(wilson_interval(60, 60)[0], 1);
  EXPECT_NEAR(wilson_interval(60, 60)[1], 1, 1e-12);
  EXPECT_EQ(wilson_interval(0, 0)[1], 1);
}

TEST(Summary, CountsFailuresAsFailures) {
  std::vector<Record> records = {record("a", true, 1), record("b", true, 3), record("c", false, 10.2),
                                 record("d", false, 0.1)};
  records[1].redraws = 2;
  records[2].found = true;  // and not verified
  const Summary s = summarise(pointers(records));
  EXPECT_EQ(s.n, 4);
  EXPECT_EQ(s.solved, 2);
  EXPECT_EQ(s.found, 3);
  EXPECT_EQ(s.first_goal, 1);
  EXPECT_EQ(s.rate, 0.5);
  EXPECT_EQ(s.mean_solved, 2);
  EXPECT_EQ(s.mean_at_limit, (1 + 3 + 10 + 10) / 4.0);
  EXPECT_EQ(s.par2, (1 + 3 + 20 + 20) / 4.0);
  EXPECT_EQ(s.percentiles[0], 1);
  EXPECT_EQ(s.percentiles[1], 3);
  EXPECT_EQ(s.percentiles[2], kInfinity);
}

TEST(Summary, OfNothingSolvedHasNoMean) {
  const std::vector<Record> records = {record("a", false, 10)};
  const Summary s = summarise(pointers(records));
  EXPECT_TRUE(std::isnan(s.mean_solved));
  EXPECT_EQ(s.par2, 20);
  EXPECT_EQ(s.percentiles[0], kInfinity);
}

TEST(Comparison, IsSumOverSumOnWhatBothSolve) {
  const std::vector<Record> first = {record("a", true, 1, 10), record("b", true, 1, 30), record("c", true, 1, 5),
                                     record("d", false, 1, 7), record("e", true, 1, 1)};
  const std::vector<Record> second = {record("b", true, 5, 300), record("a", true, 3, 500), record("c", false, 1, 9),
                                      record("d", true, 1, 7)};
  const Comparison c = compare(pointers(first), pointers(second));
  EXPECT_EQ(c.both, 2);
  EXPECT_EQ(c.only_first, 1);
  EXPECT_EQ(c.only_second, 1);
  EXPECT_EQ(c.neither, 0);
  EXPECT_EQ(c.simulations, 20);
  EXPECT_EQ(c.time, 4);
}

TEST(Comparison, PairsTheSameSeedsOnly) {
  std::vector<Record> first = {record("a", true, 1)}, second = {record("a", true, 1)};
  second[0].seed = 2;
  EXPECT_EQ(compare(pointers(first), pointers(second)).both, 0);
}

}  // namespace
}  // namespace mamo
