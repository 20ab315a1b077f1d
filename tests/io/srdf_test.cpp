#include <gmock/gmock.h>

#include "support/scratch_folder.hpp"
#include "support/shared_data.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/robot_setup.hpp"

namespace mamo::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// base -j1- l1 -j2- l2 -f (fixed)- tip, and j3 beside j2 from l1 to l3.
const char* const kUrdf = R"(<robot name="r">
  <link name="base"/><link name="l1"/><link name="l2"/><link name="l3"/><link name="tip"/>
  <joint name="j1" type="continuous"><parent link="base"/><child link="l1"/><axis xyz="0 0 1"/><limit velocity="1" effort="1"/></joint>
  <joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/><axis xyz="0 0 1"/><limit velocity="1" effort="1"/></joint>
  <joint name="j3" type="continuous"><parent link="l1"/><child link="l3"/><axis xyz="0 0 1"/><limit velocity="1" effort="1"/></joint>
  <joint name="f" type="fixed"><parent link="l2"/><child link="tip"/></joint></robot>)";

class SrdfFile : public testing::Test {
 protected:
  void SetUp() override {
    auto robot = load_urdf(folder_.write("r.urdf", kUrdf), {});
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    robot_ = *robot;
  }
  Result<Srdf> load(const std::string& body) {
    path_ = folder_.write("r.srdf", "<robot name='r'>\n" + body + "\n</robot>");
    return load_srdf(path_, *robot_.model);
  }
  void expect_error(const std::string& body, const std::string& what, int line = 2) {
    const Result<Srdf> srdf = load(body);
    ASSERT_FALSE(srdf.ok()) << "accepted, but expected: " << what;
    EXPECT_THAT(srdf.error().message, testing::StartsWith(path_ + ":" + std::to_string(line) + ": "));
    EXPECT_THAT(srdf.error().message, HasSubstr(what));
  }
  test::ScratchFolder folder_;
  RobotDescription robot_;
  std::string path_;
};

TEST_F(SrdfFile, GroupsByChainJointLinkAndSubgroup) {
  const auto srdf = load(R"(<group name="arm"><chain base_link="base" tip_link="tip"/></group>
    <group name="by_joint"><joint name="j3"/><joint name="f"/></group>
    <group name="by_link"><link name="l2"/><link name="base"/></group>
    <group name="all"><group name="both"/><link name="l1"/></group>
    <group name="both"><group name="by_joint"/><group name="by_link"/></group>)");
  ASSERT_TRUE(srdf.ok()) << srdf.error().message;
  ASSERT_EQ(srdf->groups.size(), 5u);
  EXPECT_THAT(srdf->groups[0].joints, ElementsAre("j1", "j2"));
  EXPECT_EQ(srdf->groups[0].tip, "tip");
  EXPECT_THAT(srdf->groups[1].joints, ElementsAre("j3"));
  EXPECT_THAT(srdf->groups[2].joints, ElementsAre("j2"));
  EXPECT_THAT(srdf->groups[3].joints, ElementsAre("j1", "j2", "j3"));
  EXPECT_EQ(srdf->groups[3].tip, "");
}

TEST_F(SrdfFile, StatesAndDisabledPairs) {
  const auto srdf = load(R"(<group name="arm"><chain base_link="base" tip_link="tip"/></group>
    <group_state name="up" group="arm"><joint name="j1" value="0.5"/><joint name="j2" value="-1e-1"/></group_state>
    <disable_collisions link1="l2" link2="base" reason="Never"/><disable_collisions link1="base" link2="l2"/>
    <virtual_joint name="v" type="floating" parent_frame="world" child_link="base"/>)");
  ASSERT_TRUE(srdf.ok()) << srdf.error().message;
  EXPECT_EQ(srdf->states.at("up").at("j2"), -0.1);
  EXPECT_THAT(srdf->disabled, ElementsAre(std::pair<std::string, std::string>("base", "l2")));
}

TEST_F(SrdfFile, CollisionsOffByDefaultCanBeSwitchedOnAgain) {
  const auto srdf = load("<disable_default_collisions link='l1'/><enable_collisions link1='l3' link2='l1'/>");
  ASSERT_TRUE(srdf.ok()) << srdf.error().message;
  EXPECT_EQ(srdf->disabled.size(), 3u);  // l1 against base, l2 and tip
  EXPECT_EQ(disabled_links(*srdf, *robot_.model).size(), 3u);
}

TEST_F(SrdfFile, WhatTheRobotDoesNotHaveIsAnErrorWithTheNearestName) {
  expect_error("<group name='g'><joint name='jj1'/></group>", "unknown joint 'jj1'; nearest is 'j1'");
  expect_error("<group name='g'><link name='tipp'/></group>", "unknown link 'tipp'; nearest is 'tip'");
  expect_error("<group name='g'><chain base_link='tip' tip_link='base'/></group>", "'tip' is not above link 'base'");
  expect_error("<group name='g'><group name='h'/></group>", "unknown group 'h'");
  expect_error("<group name='g'/>\n<group name='g'/>", "group 'g' is defined twice", 3);
  expect_error("<group name='g'><group name='h'/></group>\n<group name='h'><group name='g'/></group>",
               "contains itself", 3);
  expect_error("<group_state name='s' group='g'/>", "unknown group 'g'");
  expect_error("<group name='g'/><group_state name='s' group='g'><joint name='j1' value='nan'/></group_state>",
               "expected a finite number");
  expect_error("<disable_collisions link1='l1' link2='l9'/>", "unknown link 'l9'");
}

// 40 groups of which each contains the next one twice: 2^40 ways down.
TEST_F(SrdfFile, NestedGroupsCostNoMoreThanTheirNumber) {
  std::string body;
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<group name='g" + std::to_string(i + 1) + "'/>";
    body += "<group name='g" + std::to_string(i) + "'>" + next + next + "</group>\n";
  }
  const auto srdf = load(body + "<group name='g40'><joint name='j1'/></group>");
  ASSERT_TRUE(srdf.ok()) << srdf.error().message;
  EXPECT_THAT(srdf->groups[0].joints, ElementsAre("j1"));
}

TEST_F(SrdfFile, ThePandaOfMoveItIsUnderstood) {
  MAMO_SHARED_OR_SKIP(urdf, "robots/moveit_resources_panda_description/urdf/panda.urdf");
  MAMO_SHARED_OR_SKIP(path, "robots/moveit_resources_panda_description/panda.srdf");
  const auto robot = load_urdf(urdf, {});
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const auto srdf = load_srdf(path, *robot->model);
  ASSERT_TRUE(srdf.ok()) << srdf.error().message;
  GroupSpec spec;
  spec.srdf = &*srdf;
  spec.group = "panda_arm";
  spec.start = srdf->states.at("ready");
  const auto arm = make_robot(*robot, spec);
  ASSERT_TRUE(arm.ok()) << arm.error().message;
  EXPECT_EQ(arm->dof(), 7);
  EXPECT_EQ(robot->model->links[arm->group.tip.index()].name, "panda_link8");
  EXPECT_GE(srdf->disabled.size(), 19u);
  const auto hand =
      std::find_if(srdf->groups.begin(), srdf->groups.end(), [](const auto& g) { return g.name == "hand"; });
  ASSERT_NE(hand, srdf->groups.end());
  EXPECT_THAT(hand->joints, ElementsAre("panda_finger_joint1"));
}

}  // namespace
}  // namespace mamo::io
