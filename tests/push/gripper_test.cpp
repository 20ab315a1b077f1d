// The cloud of points of the gripper against the collision checker.
#include "push/gripper.hpp"

#include <gtest/gtest.h>

#include "push/tip_follower.hpp"
#include "support/push_problem.hpp"

namespace mamo::push {
namespace {

using namespace fixtures;

constexpr std::uint64_t kSeed = 9;

TEST(Gripper, WhatItCallsAHitIsOneAndMostHitsOfTheHandAreCalledOne) {
  const Problem problem = push_problem(cluttered_shelf(10, 4, 2));
  const auto kinematics = std::make_shared<ForwardKinematics>(problem.robot);
  const Gripper gripper(*kinematics);
  CollisionChecker checker(kinematics, problem.scene);
  const ObjectSet objects = ObjectSet::all(problem.scene);
  RandomStream random(kSeed, {1});
  CollisionReport report;
  int hits = 0, called = 0;
  for (int k = 0; k < 20000; ++k) {
    Eigen::VectorXd q(problem.robot.dof());
    for (int i = 0; i < problem.robot.dof(); ++i)
      q[i] = random.uniform(std::max(problem.robot.joint(i).lower, -3.2), std::min(problem.robot.joint(i).upper, 3.2));
    const Eigen::Isometry3d X_WT = kinematics->tip_pose(q);
    const bool sure = gripper.surely_hits(problem.scene, WorldState::start_of(problem.scene), objects, X_WT);
    checker.check(q, objects, true, report);
    hits += !report.touched.empty();
    called += sure;
    EXPECT_FALSE(sure && report.touched.empty()) << "seed " << kSeed << " sample " << k;
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(called, hits / 5);
}

TEST(Gripper, ReachesNoFurtherThanItsFingersBeyondTheTip) {
  const Problem problem = one_cylinder_problem();
  const ForwardKinematics kinematics(problem.robot);
  const Gripper gripper(kinematics);
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  // The tool frame is 0.18 m from the palm; the finger boxes end at 0.07691 + 0.043 + 0.052.
  EXPECT_NEAR(gripper.reach(R, Eigen::Vector3d::UnitX(), 1), 0, 1e-3);
  EXPECT_NEAR(gripper.reach(R, Eigen::Vector3d::UnitY(), 1), 0.0505, 1e-3) << "half the palm";
  EXPECT_NEAR(gripper.reach(R, -Eigen::Vector3d::UnitZ(), 1), 0.0245, 1e-3);
}

TEST(TipFollower, ReachesNearbyPosesWithinAMillimetreAndSaysWhenItCannot) {
  const Problem problem = one_cylinder_problem();
  const ForwardKinematics kinematics(problem.robot);
  TipFollower follower(kinematics);
  RandomStream random(kSeed, {2});
  for (int k = 0; k < 200; ++k) {
    Eigen::VectorXd q = problem.q_start;
    Eigen::Isometry3d target = kinematics.tip_pose(q);
    for (int i = 0; i < 3; ++i) target.translation()[i] += random.uniform(-0.02, 0.02);
    if (follower.step(target, 0.1, q) == Follow::reached) {
      EXPECT_LT((kinematics.tip_pose(q).translation() - target.translation()).norm(), 1.1e-3);
    }
    EXPECT_TRUE(problem.robot.within_limits(q));
  }
  Eigen::VectorXd q = problem.q_start;
  Eigen::Isometry3d far = kinematics.tip_pose(q);
  far.translation().x() += 2;
  EXPECT_NE(follower.step(far, 0.1, q), Follow::reached);
}

}  // namespace
}  // namespace mamo::push
