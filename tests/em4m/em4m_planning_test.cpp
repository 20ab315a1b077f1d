// E-M4M end to end, on retrievals with a known need.
#include <gtest/gtest.h>

#include "support/planned.hpp"
#include "support/push_problem.hpp"
#include "support/retrieve_problem.hpp"

namespace mamo {
namespace {

using fixtures::planned;

/// Cans in a ring about the target, so close that no gripper comes between.
Problem ring_of_cans() {
  const Object target = fixtures::target_can();
  Scene scene = fixtures::walled_in(target);
  for (Object& object : scene.objects) fixtures::constrain(object);
  return fixtures::retrieve_problem(std::move(scene), target);
}

int pushes_of(const Plan& plan) {
  return static_cast<int>(std::ranges::count(plan.segments, SegmentKind::push, &Segment::kind));
}

TEST(EnhancedM4M, AnObjectThatNothingStandsBeforeIsFetchedWithoutAPush) {
  const Problem problem = fixtures::retrieve_problem(fixtures::shelf(), fixtures::target_can());
  const PlanResult r = planned(problem, "em4m", {});
  ASSERT_EQ(r.status, PlanStatus::solved) << r.reason;
  EXPECT_TRUE(r.found && r.verified);
  EXPECT_EQ(pushes_of(r.plan), 0);
  EXPECT_EQ(r.stats.mapf_calls, 0);
}

TEST(EnhancedM4M, WhatStandsInTheWayIsPushedAsideAndTheWholePlanHolds) {
  const Problem problem = ring_of_cans();
  const PlanResult r = planned(problem, "em4m", {});
  ASSERT_EQ(r.status, PlanStatus::solved) << r.reason;
  EXPECT_GE(pushes_of(r.plan), 1);
  StopSource stop;
  EXPECT_TRUE(Verifier().judge(problem, r.plan, stop).ok);
  const std::vector<SegmentKind> end{SegmentKind::approach, SegmentKind::grasp, SegmentKind::extract};
  ASSERT_GE(r.plan.segments.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(r.plan.segments[r.plan.segments.size() - 3 + k].kind, end[k]);
  EXPECT_GT(r.cost, 0);
  EXPECT_EQ(r.suboptimality_bound, 0);
}

TEST(EnhancedM4M, ThreadsDoNotShowInTheResult) {
  const Problem problem = ring_of_cans();
  for (const char* planner : {"em4m", "em4m-negdb", "em4m-posdb", "em4m-nodb", "em4m-tiebreak"}) {
    const PlanResult serial = planned(problem, planner, {});
    for (int threads : {2, 3, 8}) {
      PlanOptions options;
      options.threads = threads;
      const PlanResult r = planned(problem, planner, options);
      EXPECT_EQ(r.signature, serial.signature) << planner << ' ' << threads;
      EXPECT_EQ(r.stats.expansions, serial.stats.expansions) << planner << ' ' << threads;
      EXPECT_EQ(r.stats.simulations_used, serial.stats.simulations_used) << planner << ' ' << threads;
      EXPECT_EQ(r.stats.failures, serial.stats.failures) << planner << ' ' << threads;
    }
  }
}

TEST(EnhancedM4M, ALimitOnSimulationsHoldsAndIsNamed) {
  PlanOptions options;
  options.max_simulations = 0;
  const PlanResult r = planned(ring_of_cans(), "em4m", options);
  EXPECT_EQ(r.status, PlanStatus::limit);
  EXPECT_EQ(r.stats.simulations_used, 0);
  EXPECT_NE(r.reason.find("--max-simulations"), std::string::npos) << r.reason;
}

TEST(EnhancedM4M, ADeadlineIsObeyedAndSaysWhatIsInTheWay) {
  const Problem problem = ring_of_cans();
  StopSource stop(0.1);  // as long as the grasps alone take
  const PlanOptions options;
  const auto begin = StopSource::Clock::now();
  const PlanResult r = planned(problem, "em4m", options, stop);
  const double took = std::chrono::duration<double>(StopSource::Clock::now() - begin).count();
  EXPECT_EQ(r.status, PlanStatus::timeout) << r.reason;
  EXPECT_TRUE(r.plan.empty());
  EXPECT_NE(r.reason.find("--time-limit"), std::string::npos) << r.reason;
  if (!fixtures::kSanitized) EXPECT_LT(took, 3.0);
}

TEST(EnhancedM4M, AnObjectBehindAWallIsNotFetchedAndTheReasonNamesIt) {
  Scene scene = fixtures::shelf();
  Object wall = fixtures::standing_cylinder("bar", 0.5, -0.5, 0.02, 0.2, ObjectKind::immovable);
  wall.shapes.front().shape = Box{{0.02, 0.8, 0.3}};
  wall.X_WO.translation() = Eigen::Vector3d(0.5, -0.5, 0.93);
  scene.objects.push_back(wall);
  const PlanResult r = planned(fixtures::retrieve_problem(std::move(scene), fixtures::target_can()), "em4m", {});
  EXPECT_NE(r.status, PlanStatus::solved);
  EXPECT_NE(r.reason.find("even without the movable objects"), std::string::npos) << r.reason;
}

TEST(EnhancedM4M, ExplainFillsTheLayersOfThePage) {
  PlanOptions options;
  options.explain = true;
  const PlanResult r = planned(ring_of_cans(), "em4m", options);
  ASSERT_FALSE(r.notes.empty());
  EXPECT_EQ(r.notes.layers.front().name, "negative goal region");
  EXPECT_GT(r.notes.layers.front().cells.indices.size(), 100u);
  options.explain = false;
  const PlanResult silent = planned(ring_of_cans(), "em4m", options);
  EXPECT_TRUE(silent.notes.empty());
  EXPECT_EQ(silent.signature, r.signature);
}

}  // namespace
}  // namespace mamo
