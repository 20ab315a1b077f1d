// The baselines that clear the way by pushes: m4m and dogar.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "support/baseline_problems.hpp"
#include "support/planned.hpp"

namespace mamo {
namespace {

using fixtures::planned;

class PushingBaseline : public testing::TestWithParam<std::string> {
 protected:
  static PlanResult solve(const Problem& problem, const PlanOptions& options, double time_limit_s = 120) {
    StopSource stop(time_limit_s);
    return planned(problem, GetParam(), options, stop);
  }
};

int pushes_of(const Plan& plan) {
  int pushes = 0;
  for (const Segment& segment : plan.segments) pushes += segment.kind == SegmentKind::push;
  return pushes;
}

TEST_P(PushingBaseline, FetchesWhatNothingIsInTheWayOfWithoutAPush) {
  const PlanResult result = solve(fixtures::nobody_in_the_way(), {});
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_TRUE(result.verified);
  EXPECT_EQ(pushes_of(result.plan), 0);
}

PlanOptions one_grasp() {
  PlanOptions options;
  options.set = fixtures::kOneGrasp;
  return options;
}

TEST_P(PushingBaseline, PushesALightObjectAway) {
  const PlanResult result = solve(fixtures::light_can_in_the_way(), one_grasp());
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_TRUE(result.found);
  EXPECT_TRUE(result.verified);
  EXPECT_GE(pushes_of(result.plan), 1);
  EXPECT_GT(result.stats.simulations_used, 0);
}

TEST_P(PushingBaseline, ThreadsDoNotChangeTheResult) {
  const Problem problem = fixtures::several_in_the_way(2);
  PlanOptions options = one_grasp();
  const PlanResult one = solve(problem, options);
  EXPECT_GE(one.stats.push_attempts, 2);
  EXPECT_TRUE(one.verified);
  const PlanResult again = solve(problem, options);
  EXPECT_EQ(one.signature, again.signature);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const PlanResult more = solve(problem, options);
    EXPECT_EQ(one.status, more.status);
    EXPECT_EQ(one.signature, more.signature) << threads << " threads";
    EXPECT_EQ(one.stats.push_attempts, more.stats.push_attempts);
    EXPECT_EQ(one.stats.simulations_used, more.stats.simulations_used);
    EXPECT_EQ(one.stats.failures, more.stats.failures);
  }
}

TEST_P(PushingBaseline, SeedsChangeTheResult) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions one = one_grasp(), two = one_grasp();
  two.seed = 2;
  EXPECT_NE(solve(problem, one).signature, solve(problem, two).signature);
}

TEST_P(PushingBaseline, EndsAtItsLimits) {
  const Problem problem = fixtures::light_can_in_the_way();
  PlanOptions options = one_grasp();
  options.max_simulations = 0;
  const PlanResult unsimulated = solve(problem, options);
  EXPECT_EQ(unsimulated.status, PlanStatus::limit);
  EXPECT_THAT(unsimulated.reason, testing::HasSubstr("simulations"));
  options = one_grasp();
  options.max_expansions = 0;
  const PlanResult unexpanded = solve(problem, options);
  EXPECT_EQ(unexpanded.status, PlanStatus::limit);
  EXPECT_THAT(unexpanded.reason, testing::HasSubstr("expansions"));
  const PlanResult late = solve(problem, {}, 0.0);
  EXPECT_EQ(late.status, PlanStatus::timeout);
  EXPECT_TRUE(late.plan.empty());
}

TEST_P(PushingBaseline, GivesUpOnWhatCannotBePushed) {
  PlanOptions options = one_grasp();
  options.set["attempts"] = "3";
  if (GetParam() == "dogar") options.set["draws"] = "2";
  const PlanResult result = solve(fixtures::wedged_can_in_the_way(), options);
  EXPECT_EQ(result.status, PlanStatus::limit) << result.reason;
  EXPECT_FALSE(result.found);
}

TEST_P(PushingBaseline, GoesOnWhenVerificationRejects) {
  for (const SegmentKind kind : {SegmentKind::push, SegmentKind::grasp}) {
    const fixtures::RefusesTheFirst judge(kind);
    StopSource stop(120);
    PlanContext context;
    context.stop = &stop;
    context.judge = &judge;
    PlanOptions options;
    options.set["grasps"] = kind == SegmentKind::push ? "1" : "20";
    const Problem asked = kind == SegmentKind::push ? fixtures::light_can_in_the_way() : fixtures::nobody_in_the_way();
    const PlanResult result = make_planner(GetParam())->plan(asked, options, context);
    ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
    EXPECT_TRUE(result.verified);
    EXPECT_EQ(result.rejected_by_verification, judge.judged() - 1);
    EXPECT_GE(judge.judged(), 2);
  }
}

TEST_P(PushingBaseline, RefusesOtherTasksAndOptions) {
  const auto planner = make_planner(GetParam());
  EXPECT_EQ(planner->name(), GetParam());
  EXPECT_FALSE(planner->can_solve(ReachPose()));
  EXPECT_FALSE(planner->can_solve(ReachJoints()));
  EXPECT_TRUE(planner->can_solve(Retrieve()));
  PlanOptions options;
  options.set = {{"no_such_option", "1"}};
  EXPECT_THROW(solve(fixtures::nobody_in_the_way(), options), std::invalid_argument);
}

TEST(Dogar, EveryObjectIsPushedOnceAndMovesAtNoOtherTime) {
  const Problem problem = fixtures::several_in_the_way(2);
  const PlanResult result = fixtures::planned(problem, "dogar", one_grasp());
  ASSERT_EQ(result.status, PlanStatus::solved) << result.reason;
  const std::vector<Segment>& segments = result.plan.segments;
  std::set<ObjectId> pushed;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].kind != SegmentKind::push) continue;
    const ObjectId object = segments[s].object;
    EXPECT_TRUE(pushed.insert(object).second);
    const Eigen::Isometry3d X_start = problem.scene[object].X_WO, X_end = segments[s].objects_after.at(object);
    EXPECT_GT((X_end.translation() - X_start.translation()).norm(), 0.01);
    for (std::size_t other = 0; other < segments.size(); ++other) {
      const Eigen::Isometry3d& X = segments[other].objects_after.at(object);
      EXPECT_LT((X.translation() - (other < s ? X_start : X_end).translation()).norm(), 1e-3) << "segment " << other;
    }
  }
  EXPECT_GE(pushed.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(All, PushingBaseline, testing::Values("m4m", "dogar"), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace mamo
