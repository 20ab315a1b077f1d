#include "mamo/io/robot_setup.hpp"

#include <gmock/gmock.h>

#include "support/scratch_folder.hpp"

namespace mamo::io {
namespace {

using testing::HasSubstr;

/// base -fix- stand -lift- l1 -turn- l2 -wrist- hand ; finger follows grip, both on the hand.
const char* const kUrdf = R"(<robot name="r">
  <link name="base"/><link name="stand"/><link name="l1"/><link name="l2"/><link name="hand"/><link name="grip_link"/><link name="finger_link"/>
  <joint name="fix" type="fixed"><parent link="base"/><child link="stand"/></joint>
  <joint name="lift" type="prismatic"><parent link="stand"/><child link="l1"/><axis xyz="0 0 1"/><limit lower="0.2" upper="0.6" velocity="1" effort="1"/></joint>
  <joint name="turn" type="revolute"><parent link="l1"/><child link="l2"/><axis xyz="0 0 1"/><limit lower="-2" upper="1" velocity="1" effort="1"/></joint>
  <joint name="wrist" type="continuous"><parent link="l2"/><child link="hand"/><axis xyz="0 0 1"/><limit velocity="1" effort="1"/></joint>
  <joint name="grip" type="revolute"><parent link="hand"/><child link="grip_link"/><axis xyz="0 0 1"/><limit lower="0" upper="1" velocity="1" effort="1"/></joint>
  <joint name="finger" type="revolute"><parent link="hand"/><child link="finger_link"/><axis xyz="0 0 1"/><limit lower="0" upper="1" velocity="1" effort="1"/><mimic joint="grip"/></joint>
</robot>)";

class RobotSetup : public testing::Test {
 protected:
  void SetUp() override {
    auto robot = load_urdf(folder_.write("r.urdf", kUrdf), {});
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    description_ = *robot;
    spec_.tip = "hand";
  }
  std::vector<std::string> group_names(const Robot& robot) {
    std::vector<std::string> names;
    for (int i = 0; i < robot.dof(); ++i) names.push_back(robot.joint(i).name);
    return names;
  }
  void expect_error(const std::string& what) {
    const Result<Robot> robot = make_robot(description_, spec_);
    ASSERT_FALSE(robot.ok()) << "accepted, but expected: " << what;
    EXPECT_THAT(robot.error().message, HasSubstr(what));
    EXPECT_THAT(robot.error().message, testing::Not(HasSubstr("\n")));
  }
  test::ScratchFolder folder_;
  RobotDescription description_;
  GroupSpec spec_;
};

TEST_F(RobotSetup, ChainFromTheRootOrFromABase) {
  auto robot = make_robot(description_, spec_);
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_THAT(group_names(*robot), testing::ElementsAre("lift", "turn", "wrist"));
  spec_.base = "l1";
  robot = make_robot(description_, spec_);
  EXPECT_THAT(group_names(*robot), testing::ElementsAre("turn", "wrist"));
  EXPECT_EQ(robot->group.base, description_.model->find_link("l1"));
}

TEST_F(RobotSetup, JointListIsPutInModelOrder) {
  spec_.joints = {"wrist", "lift"};
  const auto robot = make_robot(description_, spec_);
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_THAT(group_names(*robot), testing::ElementsAre("lift", "wrist"));
}

TEST_F(RobotSetup, ValuesFillThePostureAndTheRestStandsInsideItsLimits) {
  spec_.base = "l1";
  spec_.start = {{"turn", -1.5}, {"wrist", 30}};
  spec_.fixed = {{"grip", 0.25}};
  spec_.speed_scale = 0.5;
  spec_.X_WB.translation() = Eigen::Vector3d(1, 2, 3);
  const auto robot = make_robot(description_, spec_);
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  ASSERT_EQ(robot->posture.size(), 4);
  const auto value = [&](const char* name) {
    return robot->posture[description_.model->joints[description_.model->find_joint(name).index()].variable];
  };
  EXPECT_EQ(value("lift"), 0.2);
  EXPECT_EQ(value("turn"), -1.5);
  EXPECT_EQ(value("wrist"), 30);
  EXPECT_EQ(value("grip"), 0.25);
  EXPECT_EQ(robot->speed_scale, 0.5);
  EXPECT_EQ(robot->X_WB.translation().z(), 3);
  EXPECT_TRUE(robot->self_pairs.empty());
}

TEST_F(RobotSetup, UnknownNamesComeWithTheNearestKnownOne) {
  spec_.tip = "hnad";
  expect_error("unknown link 'hnad'; nearest is 'hand'");
  spec_.tip = "hand";
  spec_.joints = {"turm"};
  expect_error("unknown joint 'turm'; nearest is 'turn'");
  spec_.joints.clear();
  spec_.start = {{"lifft", 0}};
  expect_error("unknown joint 'lifft'; nearest is 'lift'");
}

TEST_F(RobotSetup, ImpossibleGroupsAreErrors) {
  spec_.base = "hand";
  spec_.tip = "l1";
  expect_error("'hand' is not above link 'l1'");
  spec_ = {};
  expect_error("no tip link");
  spec_.tip = "stand";
  expect_error("no joint moves between 'base' and 'stand'");
  spec_.tip = "hand";
  spec_.joints = {"turn", "turn"};
  expect_error("'turn' is named twice");
  spec_.joints = {"fix"};
  expect_error("joint 'fix' is fixed");
  spec_.joints = {"finger"};
  expect_error("joint 'finger' mimics 'grip'");
  spec_.joints = {"grip"};
  expect_error("no joint of the group moves the tip link 'hand'");
  spec_.joints.clear();
  spec_.group = "arm";
  expect_error("group 'arm' needs an SRDF file");
  Srdf srdf;
  srdf.groups = {{"arms", "base", "hand", {"turn"}}, {"empty", "", "", {}}};
  spec_.srdf = &srdf;
  expect_error("unknown group 'arm'; nearest is 'arms'");
  spec_.group = "empty";
  expect_error("group 'empty' has no joint that moves");
}

TEST_F(RobotSetup, ValuesOutsideLimitsAreErrorsWithTheLimits) {
  spec_.start = {{"turn", 1.2}};
  expect_error("joint 'turn' at 1.2 is outside its limits -2 to 1");
  spec_.start = {{"wrist", std::numeric_limits<double>::quiet_NaN()}};
  expect_error("joint 'wrist' at nan");
  spec_.start = {{"wrist", std::numeric_limits<double>::infinity()}};
  expect_error("joint 'wrist' at inf");
  spec_.start.clear();
  spec_.fixed = {{"turn", 0}};
  expect_error("joint 'turn' is fixed at a value, but belongs to the planning group");
  spec_.fixed = {{"grip", 0}};
  spec_.start = {{"grip", 0}};
  expect_error("both a start and a fixed value");
  spec_.start.clear();
  for (const double bad : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    spec_.speed_scale = bad;
    expect_error("speed_scale");
  }
}

}  // namespace
}  // namespace mamo::io
