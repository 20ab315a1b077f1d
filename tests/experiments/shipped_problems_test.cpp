// The shipped retrieval problems are planned and verified, and are what the demonstration needs.
#include <gtest/gtest.h>

#include <algorithm>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/experiments/difficulty.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo {
namespace {

Problem shipped(const std::string& name) {
  const std::string folder = MAMO_SOURCE_DIR;
  auto problem = io::load_problem(folder + "/bench/data/problems/" + name);
  EXPECT_TRUE(problem.ok()) << problem.error().message;
  choose_self_pairs(problem->robot, problem->robot_files.disabled, true, 1);
  return std::move(*problem);
}

int pushes_of_em4m(const Problem& problem) {
  const Verifier judge;
  StopSource stop(120);
  const PlanResult result = make_planner("em4m")->plan(problem, {}, {&stop, &judge, {}});
  EXPECT_EQ(result.status, PlanStatus::solved) << result.reason;
  EXPECT_TRUE(result.verified);
  return static_cast<int>(std::count_if(result.plan.segments.begin(), result.plan.segments.end(),
                                        [](const Segment& s) { return s.kind == SegmentKind::push; }));
}

TEST(ShippedProblems, TheHardShelfNeedsTwoPushesOrMore) {
  const Problem problem = shipped("shelf_2.yaml");
  EXPECT_EQ(difficulty(problem), Difficulty::hard);
  EXPECT_GE(pushes_of_em4m(problem), 2);
}

TEST(ShippedProblems, TheEasyShelfNeedsAPush) {
  const Problem problem = shipped("shelf_1.yaml");
  EXPECT_EQ(difficulty(problem), Difficulty::easy);
  EXPECT_GE(pushes_of_em4m(problem), 1);
}

}  // namespace
}  // namespace mamo
