// The robot that the project ships.
#include <gmock/gmock.h>

#include "mamo/io/load.hpp"
#include "mamo/io/robot_setup.hpp"
#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo::io {
namespace {

const std::string kRobots = std::string(MAMO_SOURCE_DIR) + "/bench/data/robots/";

struct Pr2 {
  RobotDescription description;
  Srdf srdf;
};

Pr2 load() {
  Result<RobotDescription> description = load_urdf(kRobots + "pr2_right_arm.urdf", {});
  EXPECT_TRUE(description.ok()) << description.error().message;
  Result<Srdf> srdf = load_srdf(kRobots + "pr2_right_arm.srdf", *description->model);
  EXPECT_TRUE(srdf.ok()) << srdf.error().message;
  return {*description, *srdf};
}

Robot at_home(const Pr2& pr2, const std::string& tip) {
  GroupSpec spec;
  spec.group = "right_arm";
  spec.srdf = &pr2.srdf;
  spec.tip = tip;
  spec.start = pr2.srdf.states.at("home");
  spec.fixed = pr2.srdf.states.at("parked");
  spec.fixed["torso_lift_joint"] = 0.1;
  spec.fixed["r_gripper_l_finger_joint"] = 0.2;
  Result<Robot> robot = make_robot(pr2.description, spec);
  EXPECT_TRUE(robot.ok()) << robot.error().message;
  return *robot;
}

TEST(Pr2RightArm, LoadsWithoutWarnings) {
  const Pr2 pr2 = load();
  EXPECT_THAT(pr2.description.warnings, testing::IsEmpty());
  EXPECT_EQ(pr2.description.model->links[0].name, "base_footprint");
}

TEST(Pr2RightArm, HomePutsTheGraspingFrameWhereThePublishedProblemsStart) {
  const Robot robot = at_home(load(), "r_gripper_finger_dummy_planning_link");
  const ForwardKinematics kinematics(robot);
  const Eigen::Isometry3d X_WT = kinematics.tip_pose(robot.group_part(robot.posture));
  EXPECT_LT((X_WT.translation() - Eigen::Vector3d(0.3753, -0.5777, 0.9200)).norm(), 2e-4)
      << X_WT.translation().transpose();
  EXPECT_LT((X_WT.linear().col(0) - Eigen::Vector3d(0.819, 0.572, -0.028)).norm(), 2e-3);
}

TEST(Pr2RightArm, TheSecondPublishedConfigurationAgreesToo) {
  Robot robot = at_home(load(), "r_gripper_finger_dummy_planning_link");
  robot.posture[robot.model->joints[robot.model->find_joint("torso_lift_joint").index()].variable] = 0;
  Eigen::VectorXd q(7);
  q << -1.69017, -0.0788625, -1.69017, -1.2717, -0.151824, -1.25254, 0.675062;
  const Eigen::Vector3d p = ForwardKinematics(robot).tip_pose(q).translation();
  EXPECT_LT((p - Eigen::Vector3d(0.3102, -0.6731, 0.7384)).norm(), 2e-4) << p.transpose();
}

TEST(Pr2RightArm, LimitsAreTheHardOnes) {
  const Robot robot = at_home(load(), "");
  ASSERT_EQ(robot.dof(), 7);
  EXPECT_EQ(robot.joint(0).name, "r_shoulder_pan_joint");
  EXPECT_EQ(robot.joint(0).lower, -2.2854);
  EXPECT_EQ(robot.joint(0).upper, 0.7146);
  EXPECT_EQ(robot.joint(3).lower, -2.3213);
  EXPECT_EQ(robot.joint(4).type, JointType::continuous);
  EXPECT_TRUE(std::isinf(robot.joint(6).upper));
  EXPECT_EQ(robot.joint(5).max_velocity, 3.078);
  EXPECT_EQ(robot.model->links[robot.group.tip.index()].name, "r_gripper_tool_frame");
}

// With the fingers at q the gap between the tips is 2 (0.01 + 0.00495 cos q + 0.09137 sin q - 0.0148).
TEST(Pr2RightArm, FingersOpenTogetherAndTheirTipsStayParallel) {
  const Pr2 pr2 = load();
  for (const double q : {0.0, 0.2, 0.5}) {
    GroupSpec spec;
    spec.tip = "r_gripper_tool_frame";
    spec.base = "torso_lift_link";
    spec.fixed["r_gripper_l_finger_joint"] = q;
    const Result<Robot> robot = make_robot(pr2.description, spec);
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    std::vector<Eigen::Isometry3d> X_WL;
    ForwardKinematics(*robot).link_poses(robot->group_part(robot->posture), X_WL);
    const auto pose = [&](const char* name) { return X_WL[robot->model->find_link(name).index()]; };
    const Eigen::Isometry3d palm = pose("r_gripper_palm_link");
    const Eigen::Isometry3d l = palm.inverse() * pose("r_gripper_l_finger_tip_link");
    const Eigen::Isometry3d r = palm.inverse() * pose("r_gripper_r_finger_tip_link");
    EXPECT_LT((l.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_LT((r.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    const double gap = 2 * (0.01 + 0.00495 * std::cos(q) + 0.09137 * std::sin(q) - 0.0148);
    EXPECT_NEAR(l.translation().y() - r.translation().y() - 2 * 0.0148, gap, 1e-12);
  }
}

TEST(Pr2RightArm, OnlyPairsThatMatterAreLeftForSelfCollision) {
  const Pr2 pr2 = load();
  const RobotModel& model = *pr2.description.model;
  const auto disabled = disabled_links(pr2.srdf, model);
  const auto is_disabled = [&](const char* a, const char* b) {
    const LinkId i = model.find_link(a), j = model.find_link(b);
    return std::find(disabled.begin(), disabled.end(), std::pair(std::min(i, j), std::max(i, j))) != disabled.end();
  };
  EXPECT_FALSE(is_disabled("torso_lift_link", "r_forearm_link"));
  EXPECT_FALSE(is_disabled("r_shoulder_pan_link", "r_gripper_r_finger_tip_link"));
  EXPECT_FALSE(is_disabled("head_tilt_link", "r_gripper_palm_link"));
  EXPECT_TRUE(is_disabled("head_tilt_link", "r_forearm_link"));
  EXPECT_TRUE(is_disabled("torso_lift_link", "r_upper_arm_link"));
  EXPECT_TRUE(is_disabled("r_forearm_link", "r_gripper_palm_link"));
}

TEST(Pr2RightArm, TheLeftArmHangsOutsideTheWorkspaceOfTheRightOne) {
  const Robot robot = at_home(load(), "");
  const Eigen::VectorXd home = robot.group_part(robot.posture);
  const Eigen::Isometry3d X_WL =
      ForwardKinematics(robot).link_pose(home, robot.model->find_link("l_gripper_tool_frame"));
  EXPECT_GT(X_WL.translation().y(), 0.5);
}

}  // namespace
}  // namespace mamo::io
