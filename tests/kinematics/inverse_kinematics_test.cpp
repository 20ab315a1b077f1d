#include "mamo/kinematics/inverse_kinematics.hpp"

#include "support/robots.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 20;

struct Arm {
  explicit Arm(const Robot& r = fixtures::pr2_like_arm()) : robot(r) {}
  Robot robot;
  ForwardKinematics kinematics{robot};
  InverseKinematics inverse{kinematics};
};

void expect_solution(const Arm& arm, const Eigen::VectorXd& q, const Eigen::Isometry3d& X_WT,
                     const Eigen::VectorXd& seed_q) {
  ASSERT_TRUE(arm.robot.within_limits(q));
  const auto [distance, angle] = pose_error(arm.kinematics.tip_pose(q), X_WT);
  ASSERT_LE(distance, 1e-4 + 1e-12);
  ASSERT_LE(angle, 1e-3 + 1e-12);
  for (int i = 0; i < arm.robot.dof(); ++i) {
    if (arm.robot.joint(i).type != JointType::continuous) continue;
    ASSERT_LE(std::abs(q[i] - seed_q[i]), std::numbers::pi + 1e-12);
  }
}

TEST(InverseKinematics, SolvesReachablePosesFromRandomSeeds) {
  const Arm arm;
  RandomStream random(kSeed, {1});
  const int tries = 2000;
  int solved = 0;
  for (int k = 0; k < tries; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
    const auto q = arm.inverse.solve(X_WT, seed_q, static_cast<std::uint64_t>(k));
    if (!q) continue;
    ++solved;
    expect_solution(arm, *q, X_WT, seed_q);
  }
  EXPECT_GE(solved, tries * 95 / 100) << "seed " << kSeed;
}

TEST(InverseKinematics, SolvesForFewerThanSixJointsOfSeveralKinds) {
  const Arm arm(fixtures::made_up_robot());
  RandomStream random(kSeed, {2});
  int solved = 0;
  for (int k = 0; k < 200; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
    const auto q = arm.inverse.solve(X_WT, seed_q, static_cast<std::uint64_t>(k));
    if (!q) continue;
    ++solved;
    expect_solution(arm, *q, X_WT, seed_q);
  }
  EXPECT_GE(solved, 190) << "seed " << kSeed;
}

TEST(InverseKinematics, ASeedThatIsASolutionComesBackUnchanged) {
  const Arm arm;
  RandomStream random(kSeed, {3});
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd q = fixtures::random_configuration(arm.robot, random);
    EXPECT_EQ(arm.inverse.solve(arm.kinematics.tip_pose(q), q, 1), q);
  }
}

TEST(InverseKinematics, ContinuousJointsComeBackNearTheSeedHoweverOftenItIsWound) {
  const Arm arm;
  RandomStream random(kSeed, {4});
  const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
  Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
  seed_q[4] += 14 * std::numbers::pi;
  seed_q[6] -= 100;
  const auto q = arm.inverse.solve(X_WT, seed_q, 3);
  ASSERT_TRUE(q);
  expect_solution(arm, *q, X_WT, seed_q);
}

TEST(InverseKinematics, SeveralSolutionsAreDistinctAndAcceptedOnes) {
  const Arm arm;
  RandomStream random(kSeed, {5});
  int several = 0;
  for (int k = 0; k < 50; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
    const auto elbow_in = [](const Eigen::VectorXd& q) { return q[3] < -0.5; };
    const auto found = arm.inverse.solve_many(X_WT, seed_q, 9, 5, {}, elbow_in);
    ASSERT_LE(found.size(), 5u);
    several += found.size() > 1;
    for (std::size_t a = 0; a < found.size(); ++a) {
      expect_solution(arm, found[a], X_WT, seed_q);
      ASSERT_TRUE(elbow_in(found[a]));
      for (std::size_t b = 0; b < a; ++b) {
        double apart = 0;
        for (int i = 0; i < 7; ++i) {
          const double d = found[a][i] - found[b][i];
          apart = std::max(apart, arm.robot.joint(i).type == JointType::continuous
                                      ? std::abs(std::remainder(d, 2 * std::numbers::pi))
                                      : std::abs(d));
        }
        ASSERT_GE(apart, IkOptions{}.min_separation);
      }
    }
  }
  EXPECT_GT(several, 25);
}

TEST(InverseKinematics, AnUnreachablePoseHasNoSolution) {
  const Arm arm;
  EXPECT_FALSE(arm.inverse.solve(fixtures::at(3, 0, 1), arm.robot.group_part(arm.robot.posture), 1));
}

TEST(InverseKinematics, TheSameSeedGivesTheSameBits) {
  const Arm arm, other;
  RandomStream random(kSeed, {6});
  for (int k = 0; k < 50; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const Eigen::VectorXd seed_q = fixtures::random_configuration(arm.robot, random);
    EXPECT_EQ(arm.inverse.solve_many(X_WT, seed_q, 4, 4), other.inverse.solve_many(X_WT, seed_q, 4, 4));
  }
}

TEST(InverseKinematics, TighterTolerancesAreMet) {
  const Arm arm;
  IkOptions options;
  options.position_tolerance = 1e-9;
  options.angle_tolerance = 1e-9;
  RandomStream random(kSeed, {7});
  int solved = 0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Isometry3d X_WT = arm.kinematics.tip_pose(fixtures::random_configuration(arm.robot, random));
    const auto q = arm.inverse.solve(X_WT, fixtures::random_configuration(arm.robot, random), 2, options);
    if (!q) continue;
    ++solved;
    const auto [distance, angle] = pose_error(arm.kinematics.tip_pose(*q), X_WT);
    ASSERT_LE(distance, 2e-9);
    ASSERT_LE(angle, 2e-9);
  }
  EXPECT_GE(solved, 95) << "seed " << kSeed;
}

TEST(PoseError, IsDistanceAndAngle) {
  const Eigen::Isometry3d A = fixtures::at(1, 2, 3, 0.3);
  for (double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, 3.1, std::numbers::pi - 1e-9}) {
    const Eigen::Isometry3d B = fixtures::at(1, 2, 3.5, 0.3 + angle);
    EXPECT_NEAR(pose_error(A, B).first, 0.5, 1e-12);
    EXPECT_NEAR(pose_error(A, B).second, angle, 1e-9) << angle;
  }
}

}  // namespace
}  // namespace mamo
