// The baselines that come to the grasp by touching what they may: rrt, kpiece, and selsim on retrieval problems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "support/baseline_problems.hpp"
#include "support/planned.hpp"

namespace mamo {
namespace {

using fixtures::planned;

PlanResult solve(const std::string& planner, const Problem& problem, const PlanOptions& options,
                 double time_limit_s = 200) {
  StopSource stop(time_limit_s);
  return planned(problem, planner, options, stop);
}

std::vector<SegmentKind> kinds(const Plan& plan) {
  std::vector<SegmentKind> out;
  for (const Segment& segment : plan.segments) out.push_back(segment.kind);
  return out;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

PlanOptions one_grasp() {
  PlanOptions options;
  options.set = fixtures::kOneGrasp;
  return options;
}

class ReachingBaseline : public testing::TestWithParam<std::string> {};

TEST_P(ReachingBaseline, FetchesWhatNothingIsInTheWayOf) {
  const PlanResult result = solve(GetParam(), fixtures::nobody_in_the_way(), {});
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_TRUE(result.verified);
  EXPECT_EQ(kinds(result.plan),
            (std::vector<SegmentKind>{SegmentKind::approach, SegmentKind::grasp, SegmentKind::extract}));
}

TEST_P(ReachingBaseline, FetchesWhatALightObjectIsInTheWayOf) {
  PlanOptions options = one_grasp();
  if (GetParam() == "rrt") options.set["goal_distance"] = "1.0";  // one goal and a bias of 5 % take it minutes else
  const PlanResult result = solve(GetParam(), fixtures::light_can_in_the_way(), options);
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_TRUE(result.verified);
  EXPECT_GT(result.stats.simulations_used, 2);
}

TEST_P(ReachingBaseline, RepeatsItselfAtEveryThreadCount) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions options = one_grasp();
  options.seed = 5;
  options.max_expansions = 150;
  const PlanResult one = solve(GetParam(), problem, options);
  for (const int threads : {1, 2, 3}) {
    options.threads = threads;
    const PlanResult more = solve(GetParam(), problem, options);
    EXPECT_EQ(one.status, more.status);
    EXPECT_EQ(one.signature, more.signature) << threads << " threads";
    EXPECT_EQ(one.stats.expansions, more.stats.expansions);
    EXPECT_EQ(one.stats.simulations_used, more.stats.simulations_used);
    EXPECT_EQ(one.stats.failures, more.stats.failures);
  }
}

TEST_P(ReachingBaseline, EndsAtItsLimits) {
  Problem problem = fixtures::light_can_in_the_way();
  PlanOptions options = one_grasp();
  options.max_simulations = 0;
  EXPECT_EQ(solve(GetParam(), problem, options).status, PlanStatus::limit);
  options = one_grasp();
  options.max_expansions = 1;
  const PlanResult unexpanded = solve(GetParam(), problem, options);
  EXPECT_EQ(unexpanded.status, PlanStatus::limit);
  EXPECT_LE(unexpanded.stats.expansions, 1);
  EXPECT_THAT(unexpanded.reason, testing::HasSubstr("expansions"));
  const PlanResult late = solve(GetParam(), problem, {}, 0.0);
  EXPECT_EQ(late.status, PlanStatus::timeout);
  EXPECT_TRUE(late.plan.empty());
}

TEST_P(ReachingBaseline, NeverFindsAPlanThatMovesWhatMustStay) {
  PlanOptions options = one_grasp();
  options.max_expansions = 100;
  const PlanResult result = solve(GetParam(), fixtures::wedged_can_in_the_way(), options);
  if (result.status == PlanStatus::solved)
    EXPECT_TRUE(result.verified);
  else
    EXPECT_EQ(result.status, PlanStatus::limit) << result.reason;
}

TEST_P(ReachingBaseline, GoesOnWhenVerificationRejects) {
  const fixtures::RefusesTheFirst judge(SegmentKind::approach);
  StopSource stop(120);
  PlanContext context;
  context.stop = &stop;
  context.judge = &judge;
  const PlanResult result = make_planner(GetParam())->plan(fixtures::nobody_in_the_way(), {}, context);
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_EQ(result.rejected_by_verification, judge.judged() - 1);
  EXPECT_GE(judge.judged(), 2);
}

TEST_P(ReachingBaseline, RefusesUnknownOptions) {
  PlanOptions options;
  options.set = {{"no_such_option", "1"}};
  EXPECT_THROW(solve(GetParam(), fixtures::nobody_in_the_way(), options), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(All, ReachingBaseline, testing::Values("rrt", "kpiece", "selsim", "selsim-wastar", "fullsim"),
                         name_of);

class SamplingBaseline : public testing::TestWithParam<std::string> {};

TEST_P(SamplingBaseline, RefusesOtherTasks) {
  const auto planner = make_planner(GetParam());
  EXPECT_EQ(planner->name(), GetParam());
  EXPECT_FALSE(planner->can_solve(ReachPose()));
  EXPECT_FALSE(planner->can_solve(ReachJoints()));
  EXPECT_TRUE(planner->can_solve(Retrieve()));
}

TEST_P(SamplingBaseline, SeedsChangeTheResult) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions one, two;
  two.seed = 2;
  one.max_expansions = two.max_expansions = 60;
  EXPECT_NE(solve(GetParam(), problem, one).signature, solve(GetParam(), problem, two).signature);
}

TEST_P(SamplingBaseline, OtherThreadsPlanningAtTheSameTimeChangeNothing) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions options;
  options.max_expansions = 60;
  const PlanResult alone = solve(GetParam(), problem, options);
  std::vector<PlanResult> together(3);
  {
    std::vector<std::jthread> threads;
    for (PlanResult& result : together) threads.emplace_back([&] { result = solve(GetParam(), problem, options); });
  }
  for (const PlanResult& result : together) {
    EXPECT_EQ(result.signature, alone.signature);
    EXPECT_EQ(result.stats.simulations_used, alone.stats.simulations_used);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SamplingBaseline, testing::Values("rrt", "kpiece"), name_of);

TEST(SelSimOnRetrieval, PrimitivesOfSingleJointsAreAnotherSearch) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions options = one_grasp();
  options.max_expansions = 60;
  const PlanResult ours = solve("selsim", problem, options);
  options.set["primitives"] = "single";
  const PlanResult single = solve("selsim", problem, options);
  EXPECT_NE(ours.signature, single.signature);
  options.set["primitives"] = "double";
  EXPECT_THROW(solve("selsim", problem, options), std::invalid_argument);
}

}  // namespace
}  // namespace mamo
