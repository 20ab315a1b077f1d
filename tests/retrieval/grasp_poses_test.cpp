// Variations of a grasp around the given pre-grasp.
#include "retrieval/grasp_poses.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/retrieve_problem.hpp"

namespace mamo {
namespace {

using namespace fixtures;
using retrieval::grasp_poses;
using retrieval::GraspPose;

TEST(GraspPoses, TheFirstIsTheGivenPreGraspAndTheTipPassesTheCentre) {
  const Object can = target_can();
  const Eigen::Isometry3d X = pregrasp_of(can, 0.6, 0.1);
  const std::vector<GraspPose> poses = grasp_poses(can, X, 50);
  ASSERT_EQ(poses.size(), 50u);
  EXPECT_TRUE(poses[0].X_WT_pregrasp.isApprox(X, 1e-12));
  const Eigen::Vector3d beyond = poses[0].X_WT.translation() - can.X_WO.translation();
  EXPECT_NEAR(beyond.x(), 0.025 * std::cos(0.6), 1e-9);
  EXPECT_NEAR(beyond.y(), 0.025 * std::sin(0.6), 1e-9);
  EXPECT_NEAR(beyond.z(), 0, 1e-9);
}

TEST(GraspPoses, EveryApproachIsLevelStraightAndAimsAtTheCentre) {
  const Object can = target_can();
  const Eigen::Vector3d centre = can.X_WO.translation();
  const std::vector<GraspPose> poses = grasp_poses(can, pregrasp_of(can, 0.6, 0.1), 1000);
  std::set<std::vector<int>> distinct;
  for (const GraspPose& p : poses) {
    const Eigen::Vector3d shift = p.X_WT.translation() - p.X_WT_pregrasp.translation();
    EXPECT_NEAR(p.direction.z(), 0, 1e-12);
    EXPECT_NEAR(shift.cross(p.direction).norm(), 0, 1e-12);
    EXPECT_TRUE(p.X_WT.linear().isApprox(p.X_WT_pregrasp.linear(), 1e-12));
    EXPECT_TRUE(p.X_WT.linear().col(0).isApprox(p.direction, 1e-9)) << "the given tip looked ahead; so do all";
    const Eigen::Vector3d to_centre = centre - p.X_WT_pregrasp.translation();
    EXPECT_NEAR(to_centre.head<2>().norm(), 0.1, 1e-9);
    EXPECT_NEAR(to_centre.x() * p.direction.y() - to_centre.y() * p.direction.x(), 0, 1e-9);
    EXPECT_LT(std::abs(to_centre.z()), 0.08) << "between bottom and top";
    distinct.insert({static_cast<int>(std::lround(1000 * p.direction.y())), static_cast<int>(1000 * to_centre.z()),
                     static_cast<int>(1000 * shift.norm())});
  }
  EXPECT_EQ(distinct.size(), poses.size());
}

TEST(GraspPoses, TheTipGoesNoDeeperThanThePalmAllows) {
  Object box = target_can();
  box.shapes = {{Box{{0.16, 0.16, 0.2}}, Eigen::Isometry3d::Identity()}};
  for (const GraspPose& p : grasp_poses(box, pregrasp_of(box, 0.0, 0.13), 1000)) {
    const double beyond = (p.X_WT.translation() - box.X_WO.translation()).dot(p.direction);
    const double half = 0.08 * (std::abs(p.direction.x()) + std::abs(p.direction.y()));
    EXPECT_LE(beyond, 0.075 - half + 1e-9);
    EXPECT_GE(beyond, -half + 0.02) << "or it holds nothing";
  }
}

TEST(GraspPoses, FromAboveTheApproachGoesStraightDown) {
  const Object can = target_can();
  Eigen::Isometry3d X = at(0.72, -0.5, can.X_WO.translation().z() + 0.15);
  X.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const std::vector<GraspPose> poses = grasp_poses(can, X, 1000);
  ASSERT_FALSE(poses.empty());
  for (const GraspPose& p : poses) EXPECT_TRUE(p.direction.isApprox(-Eigen::Vector3d::UnitZ()));
}

}  // namespace
}  // namespace mamo
