#include <gmock/gmock.h>

#include "support/scratch_folder.hpp"
#include "support/shared_data.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/robot_setup.hpp"
#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kTwoLinks = R"(<robot name="r">
<link name="a"/>
<link name="b"/>
)";
const std::string kHinge = R"(<joint name="hinge" type="revolute"><parent link="a"/><child link="b"/>
<axis xyz="0 0 2"/><limit lower="-1" upper="2" velocity="3" effort="1"/></joint>
)";

class Urdf : public testing::Test {
 protected:
  Result<RobotDescription> load(const std::string& text) { return load_urdf(path(text), {}); }
  std::string path(const std::string& text) { return folder_.write("robot.urdf", text); }
  /// One line that starts with the file (and the line of the problem, if given), and says `what`.
  void expect_error(const std::string& text, const std::string& what, int line = 0) {
    const std::string file = path(text);
    const Result<RobotDescription> loaded = load_urdf(file, {});
    ASSERT_FALSE(loaded.ok()) << "accepted, but expected: " << what;
    const std::string& message = loaded.error().message;
    EXPECT_THAT(message, StartsWith(file + ":" + (line ? std::to_string(line) + ":" : "")));
    EXPECT_THAT(message, HasSubstr(what));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    EXPECT_EQ(loaded.error().kind, ErrorKind::invalid_input);
  }
  test::ScratchFolder folder_;
};

TEST_F(Urdf, EveryJointTypeIsRead) {
  const auto robot = load(R"(<robot name="all">
    <link name="l0"/><link name="l1"/><link name="l2"/><link name="l3"/><link name="l4"/>
    <joint name="j1" type="fixed"><parent link="l0"/><child link="l1"/><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/></joint>
    <joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><axis xyz="0 3 0"/>
      <limit lower="-0.5" upper="+1.5" velocity="2" effort="1"/></joint>
    <joint name="j3" type="continuous"><parent link="l2"/><child link="l3"/><axis xyz="1 0 0"/></joint>
    <joint name="j4" type="prismatic"><parent link="l3"/><child link="l4"/><axis xyz="0 0 1"/>
      <limit lower="0" upper="0.3" velocity="0.1" effort="1"/></joint>
  </robot>)");
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const RobotModel& model = *robot->model;
  ASSERT_EQ(model.joints.size(), 4u);
  EXPECT_EQ(model.joints[0].type, JointType::fixed);
  EXPECT_EQ(model.joints[0].variable, -1);
  EXPECT_TRUE(model.joints[0].X_PJ.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_EQ(model.joints[1].type, JointType::revolute);
  EXPECT_TRUE(model.joints[1].axis.isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_EQ(model.joints[1].upper, 1.5);
  EXPECT_EQ(model.joints[2].type, JointType::continuous);
  EXPECT_TRUE(std::isinf(model.joints[2].lower));
  EXPECT_EQ(model.joints[2].max_velocity, 1.0);
  EXPECT_THAT(robot->warnings, testing::ElementsAre(HasSubstr("'j3' has no velocity limit")));
  EXPECT_EQ(model.joints[3].type, JointType::prismatic);
  EXPECT_EQ(model.variables, 3);
  for (std::size_t i = 0; i < model.joints.size(); ++i) EXPECT_EQ(model.joints[i].child, LinkId(i + 1));
}

TEST_F(Urdf, PrimitiveShapesKeepSizesAndPlaces) {
  const auto robot = load(R"(<robot name="r"><link name="a"><inertial><mass value="2.5"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry></collision>
    <collision><geometry><cylinder radius="0.1" length="0.4"/></geometry></collision>
    <collision><geometry><sphere radius="0.2"/></geometry></collision>
    <visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>)");
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const Link& link = robot->model->links[0];
  ASSERT_EQ(link.collision.size(), 3u);
  EXPECT_EQ(describe(link.collision[0].shape), "box 1 x 2 x 3");
  EXPECT_EQ(link.collision[0].X_BS.translation().z(), 1);
  EXPECT_EQ(describe(link.collision[1].shape), "cylinder r 0.1 l 0.4");
  EXPECT_EQ(describe(link.collision[2].shape), "sphere r 0.2");
  EXPECT_EQ(link.visual.size(), 1u);
  EXPECT_EQ(link.mass, 2.5);
}

std::string mimicking(const std::string& a, const std::string& b, const std::string& c) {
  const auto joint = [](const std::string& name, const char* parent, const char* child, const std::string& mimic) {
    return "<joint name='" + name + "' type='revolute'><parent link='" + parent + "'/><child link='" + child +
           "'/><axis xyz='0 0 1'/><limit lower='-9' upper='9' velocity='1' effort='1'/>" + mimic + "</joint>\n";
  };
  return "<robot name='r'><link name='0'/><link name='1'/><link name='2'/><link name='3'/>\n" +
         joint("a", "0", "1", a) + joint("b", "1", "2", b) + joint("c", "2", "3", c) + "</robot>";
}

TEST_F(Urdf, MimicChainsAreResolvedToTheJointThatMoves) {
  const auto robot = load(
      mimicking("<mimic joint='b' multiplier='2' offset='1'/>", "<mimic joint='c' multiplier='-3' offset='0.5'/>", ""));
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const RobotModel& model = *robot->model;
  EXPECT_EQ(model.variables, 1);
  const Joint& a = model.joints[model.find_joint("a").index()];
  ASSERT_TRUE(a.mimic);
  EXPECT_EQ(a.mimic->joint, model.find_joint("c"));
  EXPECT_EQ(a.mimic->multiplier, -6);
  EXPECT_EQ(a.mimic->offset, 2);  // a = 2 b + 1, b = -3 c + 0.5
}

TEST_F(Urdf, MimicCirclesNameTheirJoints) {
  expect_error(mimicking("<mimic joint='b'/>", "<mimic joint='c'/>", "<mimic joint='a'/>"), "a -> b -> c -> a", 2);
  expect_error(mimicking("<mimic joint='a'/>", "", ""), "circle: a -> a", 2);
  expect_error(mimicking("<mimic joint='bb'/>", "", ""), "unknown joint 'bb'; nearest is 'b'", 2);
}

TEST_F(Urdf, WhatUrdfdomWouldDropInSilenceIsAnError) {
  expect_error(
      "<robot name='r'>\n<link name='arm'><collision><geometry>\n<capsule radius='1' length='2'/></geometry>"
      "</collision></link></robot>",
      "link 'arm': unsupported geometry <capsule>", 3);
}

TEST_F(Urdf, JointTypesThatHaveNoConfigurationAreErrors) {
  expect_error(kTwoLinks + "<joint name='j' type='floating'><parent link='a'/><child link='b'/></joint></robot>",
               "type 'floating' is not supported", 4);
  expect_error(kTwoLinks + "<joint name='j' type='planar'><parent link='a'/><child link='b'/></joint></robot>",
               "type 'planar' is not supported", 4);
  expect_error(kTwoLinks + "<joint name='j' type='ball'><parent link='a'/><child link='b'/></joint></robot>",
               "type 'ball', expected fixed", 4);
}

TEST_F(Urdf, BadNumbersAreErrorsWithTheirLine) {
  const auto link = [](const std::string& geometry) {
    return "<robot name='r'>\n<link name='a'><collision><geometry>" + geometry +
           "</geometry></collision></link></robot>";
  };
  expect_error(link("<box size='1 2 nan'/>"), "<box size> is '1 2 nan', expected 3 finite numbers", 2);
  expect_error(link("<box size='1 2'/>"), "expected 3 finite numbers", 2);
  expect_error(link("<box size='1 2 0'/>"), "expected sizes above 0", 2);
  expect_error(link("<sphere radius='-1'/>"), "expected sizes above 0", 2);
  expect_error(link("<sphere radius='inf'/>"), "expected a finite number", 2);
  expect_error(link("<sphere radius='1e999'/>"), "expected a finite number", 2);
  expect_error(link("<sphere/>"), "<sphere radius> is missing", 2);
  expect_error(link("<cylinder radius='1,5' length='1'/>"), "expected a finite number", 2);
  expect_error(link("<mesh/>"), "<mesh> without a filename", 2);
  expect_error(link(""), "without a geometry", 2);
  expect_error(kTwoLinks +
                   "<joint name='j' type='prismatic'><parent link='a'/><child link='b'/>\n"
                   "<limit lower='2' upper='1' velocity='1' effort='1'/></joint></robot>",
               "lower limit 2 is above upper limit 1", 5);
  expect_error(kTwoLinks +
                   "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>\n<axis xyz='0 0 0'/>"
                   "</joint></robot>",
               "axis of length 0", 5);
}

TEST_F(Urdf, BrokenTreesAreErrors) {
  expect_error(kTwoLinks + "</robot>", "not a valid URDF");  // two roots
  expect_error(kTwoLinks + "<link name='a'/></robot>", "link 'a' is defined twice (first in line 2)", 4);
  expect_error(kTwoLinks + kHinge + kHinge + "</robot>", "joint 'hinge' is defined twice", 6);
  expect_error(kTwoLinks + "<joint name='j' type='fixed'><parent link='aa'/><child link='b'/></joint></robot>",
               "unknown link 'aa'; nearest is 'a'", 4);
  expect_error(kTwoLinks + "<joint name='j' type='fixed'><parent link='a'/></joint></robot>", "has no <child>", 4);
  expect_error(kTwoLinks + "<joint name='j' type='revolute'><parent link='a'/><child link='b'/></joint></robot>",
               "needs <limit>", 4);
  expect_error("<robot name='r'></robot>", "no <link>", 1);
  expect_error("<robot name='r'><link/></robot>", "<link> without a name", 1);
  expect_error(kTwoLinks +
                   "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
                   "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
               "not a valid URDF");  // no root
}

TEST_F(Urdf, FilesThatAreNoUrdfAreErrors) {
  expect_error("", "empty file");
  expect_error(std::string("\x7f"
                           "ELF\0\0\1",
                           7),
               "binary file");
  expect_error("<robot name='r'>\n<link name='a'>", "not well-formed XML: an element is never closed", 2);
  expect_error("<robot name='r'>\n<link name='a'></joint></robot>", "not well-formed XML", 2);
  expect_error("plain text", "not well-formed XML");
  expect_error("<sdf/>", "root element is <sdf>, expected <robot>", 1);
  expect_error("<!DOCTYPE robot [<!ENTITY a 'b'>]>\n<robot name='r'><link name='&a;'/></robot>", "DOCTYPE", 1);
  expect_error("<robot name='r' xmlns:xacro='x'>\n<xacro:include filename='f'/></robot>", "xacro", 2);
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<a>";
  expect_error("<robot name='r'>" + deep, "nested too deeply", 1);
  const auto missing = load_urdf(folder_.path() + "/none.urdf", {});
  EXPECT_THAT(missing.error().message, HasSubstr("none.urdf: no such file"));
  EXPECT_THAT(load_urdf(folder_.path(), {}).error().message, HasSubstr("is a folder"));
  expect_error(std::string((16u << 20) + 1, ' '), "is too large");
}

TEST_F(Urdf, EveryPrefixOfAFileIsAnError) {
  const std::string text = kTwoLinks + kHinge + "</robot>";
  ASSERT_TRUE(load(text).ok());
  for (std::size_t size = 0; size + 1 < text.size(); size += 3) EXPECT_FALSE(load(text.substr(0, size)).ok()) << size;
}

TEST_F(Urdf, MissingCollisionMeshesAreErrorsAndMissingVisualsAreWarnings) {
  const std::string mesh = "<geometry><mesh filename='package://some_robot/m.stl'/></geometry>";
  expect_error("<robot name='r'>\n<link name='arm'><collision>" + mesh + "</collision></link></robot>",
               "link 'arm': collision mesh 'package://some_robot/m.stl' not found; tried " + folder_.path() +
                   "/m.stl, " + folder_.path() + "/some_robot/m.stl",
               2);
  const auto robot = load("<robot name='r'><link name='arm'><visual>" + mesh + "</visual></link></robot>");
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_THAT(robot->warnings, testing::ElementsAre(AllOf(HasSubstr("link 'arm': visual mesh"), HasSubstr("tried"))));
  EXPECT_EQ(robot->model->links[0].visual[0].mesh_path, "");
}

TEST_F(Urdf, AFlatCollisionMeshNamesFileAndLink) {
  folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  expect_error(
      "<robot name='r'>\n<link name='arm'><collision><geometry><mesh filename='flat.obj'/></geometry>"
      "</collision></link></robot>",
      "link 'arm': collision mesh " + folder_.path() + "/flat.obj: mesh has no volume", 2);
}

TEST_F(Urdf, TheRealPr2LoadsUnmodified) {
  MAMO_SHARED_OR_SKIP(path, "robots/pr2/pr2.urdf");
  const auto robot = load_urdf(path, {});
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  GroupSpec spec;
  spec.base = "torso_lift_link";
  spec.tip = "r_gripper_tool_frame";
  spec.fixed["torso_lift_joint"] = 0.1;
  spec.start = {{"r_shoulder_pan_joint", -1.68651},   {"r_shoulder_lift_joint", -0.184315},
                {"r_upper_arm_roll_joint", -1.67611}, {"r_elbow_flex_joint", -1.66215},
                {"r_forearm_roll_joint", 0.285096},   {"r_wrist_flex_joint", -0.658798},
                {"r_wrist_roll_joint", 1.41563}};
  const auto arm = make_robot(*robot, spec);
  ASSERT_TRUE(arm.ok()) << arm.error().message;
  const ForwardKinematics kinematics(*arm);
  const Eigen::Isometry3d X_WT = kinematics.tip_pose(arm->group_part(arm->posture));
  // The published start is that of the frame 0.02 m further out.
  const Eigen::Vector3d tip = X_WT * Eigen::Vector3d(0.02, 0, 0);
  EXPECT_LT((tip - Eigen::Vector3d(0.3753, -0.5777, 0.9200)).norm(), 2e-4) << tip.transpose();
}

TEST_F(Urdf, TheRealPandaLoadsUnmodifiedFromItsPackage) {
  MAMO_SHARED_OR_SKIP(path, "robots/moveit_resources_panda_description/urdf/panda.urdf");
  const std::map<std::string, std::string> packages = {
      {"moveit_resources_panda_description", mamo::test::shared_data() + "/robots/moveit_resources_panda_description"}};
  for (const auto& package_path : {packages, std::map<std::string, std::string>{}}) {  // given, or an ancestor folder
    const auto robot = load_urdf(path, package_path);
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    EXPECT_EQ(robot->model->variables, 8);
    for (const Link& link : robot->model->links)
      for (const PlacedShape& placed : link.collision)
        EXPECT_LE(std::get<Mesh>(placed.shape).hull->vertices.size(), 96u) << link.name;
    const Joint& second = robot->model->joints[robot->model->find_joint("panda_finger_joint2").index()];
    ASSERT_TRUE(second.mimic);
    EXPECT_EQ(second.mimic->joint, robot->model->find_joint("panda_finger_joint1"));
  }
}

}  // namespace
}  // namespace mamo::io
