#include "experiments/shipped_robot.hpp"

#include <gmock/gmock.h>

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

Problem with_pr2() {
  Problem problem;
  const Status installed = install_shipped_pr2(problem, "r_gripper_tool_frame");
  EXPECT_TRUE(installed.ok()) << installed.error().message;
  return problem;
}

bool hits_itself(const Problem& problem, const Eigen::VectorXd& q) {
  CollisionChecker checker(std::make_shared<ForwardKinematics>(problem.robot), problem.scene);
  CollisionReport report;
  checker.check(q, {}, true, report);
  return report.self;
}

TEST(ShippedRobot, HomeIsFreeOfSelfCollision) {
  const Problem problem = with_pr2();
  EXPECT_FALSE(hits_itself(problem, problem.q_start));
  // The start of the published scenes' own section S.
  Eigen::VectorXd q(7);
  q << -1.69017, -0.0788625, -1.69017, -1.2717, -0.151824, -1.25254, 0.675062;
  EXPECT_FALSE(hits_itself(problem, q));
}

// The arm reaches ahead and down, the elbow bent as far as it goes: the hand ends up before the chest.
TEST(ShippedRobot, TheHandMeetsTheChest) {
  const Problem problem = with_pr2();
  Eigen::VectorXd q(7);
  q << 0.5, 0.6, 0.0, -2.3, 0.0, -1.5, 0.0;
  EXPECT_TRUE(hits_itself(problem, q));
}

TEST(ShippedRobot, FewPairsAreTestedForSelfCollision) {
  const Problem problem = with_pr2();
  EXPECT_EQ(problem.robot.self_pairs.size(), 61u);
  EXPECT_TRUE(problem.robot.disabled_pairs.empty()) << "no pair had to be found by sampling";
}

}  // namespace
}  // namespace mamo
