#include "mamo/kinematics/inverse_kinematics.hpp"

#include <cstdio>

#include "support/robots.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 20;

struct Arm {
  Robot robot = fixtures::pr2_like_arm();
  ForwardKinematics kinematics{robot};
  InverseKinematics inverse{kinematics};
};

TEST(InverseKinematics, SolvesReachablePosesFromRandomSeeds) {
  const Arm arm;
  RandomStream random(kSeed, {1});
  const int tries = 1000;
  int solved = 0;
  for (int k = 0; k < tries; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
    const auto q = arm.inverse.solve(X_WT, seed_q, static_cast<std::uint64_t>(k));
    if (!q) continue;
    ++solved;
    ASSERT_TRUE(arm.robot.within_limits(*q)) << "seed " << kSeed << ", pose " << k;
    const auto [distance, angle] = pose_error(arm.kinematics.tip_pose(*q), X_WT);
    ASSERT_LE(distance, 1e-4 + 1e-12);
    ASSERT_LE(angle, 1e-3 + 1e-12);
    for (int i = 0; i < 7; ++i) {
      if (arm.robot.joint(i).type == JointType::continuous) {
        ASSERT_LE(std::abs((*q)[i] - seed_q[i]), std::numbers::pi + 1e-12);
      }
    }
  }
  std::printf("solved %d of %d\n", solved, tries);
  EXPECT_GE(solved, tries * 95 / 100) << "seed " << kSeed;
}

}  // namespace
}  // namespace mamo
