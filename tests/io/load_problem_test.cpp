// What the native problem file means, value by value, and what the file options do to it.
#include <gmock/gmock.h>

#include <numbers>

#include "support/bad_inputs.hpp"
#include "support/scratch_folder.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/profile.hpp"

namespace mamo {
namespace {

using test::problem_with;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

class LoadProblem : public ::testing::Test {
 protected:
  Result<Problem> try_load(const std::string& text, const io::LoadOptions& options = {}) {
    return io::load_problem(folder.write("problem.yaml", text), options);
  }
  Problem load(const std::string& text, const io::LoadOptions& options = {}) {
    Result<Problem> problem = try_load(text, options);
    if (!problem) throw std::runtime_error(problem.error().message);
    return std::move(*problem);
  }
  test::ScratchFolder folder;
};

TEST_F(LoadProblem, ReadsTheWholeExample) {
  const Problem p = load(test::good_problem());
  EXPECT_EQ(p.name, "problem.yaml");
  EXPECT_EQ(p.profile, Profile::full);
  ASSERT_EQ(p.scene.size(), 3u);
  const Object& table = p.scene.objects[0];
  EXPECT_EQ(table.kind, ObjectKind::fixture);
  EXPECT_EQ(table.constraints.touch, Touch::support);
  EXPECT_EQ(std::get<Box>(table.shapes[0].shape).size, Eigen::Vector3d(0.6, 0.8, 0.04)) << "full sizes";
  const Object& can = p.scene.objects[1];
  EXPECT_EQ(can.kind, ObjectKind::movable);
  EXPECT_EQ(can.mass, 0.35);
  EXPECT_EQ(can.friction, 0.9);
  EXPECT_EQ(std::get<Cylinder>(can.shapes[0].shape).length, 0.1);
  EXPECT_NEAR(can.constraints.max_tilt, 25 * kPi / 180, 1e-15);
  EXPECT_EQ(can.constraints.max_speed, 1.0);
  EXPECT_FALSE(can.constraints.may_leave_support);
  EXPECT_EQ(can.constraints.touch, Touch::allowed);
  const Object& cup = p.scene.objects[2];
  EXPECT_EQ(cup.kind, ObjectKind::immovable);
  EXPECT_EQ(cup.constraints.touch, Touch::forbidden);
  EXPECT_EQ(cup.friction, 0.8) << "the default";
  const ReachPose& task = std::get<ReachPose>(p.task);
  EXPECT_EQ(task.X_WT.translation(), Eigen::Vector3d(0.7, -0.4, 0.9));
  EXPECT_EQ(task.target, ObjectId{2});
  EXPECT_EQ(p.robot.dof(), 8) << "the torso lies between base and tip";
  EXPECT_EQ(p.q_start[0], 0.1);
  EXPECT_EQ(p.robot.speed_scale, 0.1);
}

TEST_F(LoadProblem, TheSha256IsThatOfTheFilesBytes) {
  io::LoadOptions none;
  const Result<Problem> p = io::load_problem(folder.write("x.yaml", test::good_problem()), none);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->sha256.size(), 64u);
  const Result<Problem> q = io::load_problem(folder.write("x.yaml", test::good_problem() + "# a comment\n"), none);
  EXPECT_NE(p->sha256, q->sha256);
}

TEST_F(LoadProblem, RpyIsRollPitchYawAboutFixedAxes) {
  const Problem p = load(problem_with("0.82], rpy: [0, 0, 0]", "0.8], rpy_deg: [90, 0, 90]"));
  // x: roll keeps it, yaw takes it to y. z: roll takes it to -y, yaw on to x.
  EXPECT_TRUE(
      (p.scene[ObjectId{1}].X_WO.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(
      (p.scene[ObjectId{1}].X_WO.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
}

TEST_F(LoadProblem, QuaternionsAreXyzwAndAreNormalisedWithAWarning) {
  const double s = std::sqrt(0.5);
  const Problem p = load(problem_with("quaternion: [0, 0, 0, 1]", "quaternion: [0, 0, 2, 2]"));
  EXPECT_TRUE(
      std::get<ReachPose>(p.task).X_WT.linear().isApprox(Eigen::Quaterniond(s, 0, 0, s).toRotationMatrix(), 1e-12));
  ASSERT_EQ(p.warnings.size(), 1u);
  EXPECT_THAT(p.warnings[0], HasSubstr("was normalised"));
}

TEST_F(LoadProblem, NumbersOverrideTheProfileAndAnObjectsOwnOverrideBoth) {
  std::string text =
      problem_with("{profile: full}", "{profile: full, max_speed: 0.5, max_tilt_deg: 10, max_displacement: .inf}");
  text.replace(text.find("movable: true}"), 14, "movable: true, constraints: {max_tilt: 0.2, touch: robot}}");
  const InteractionConstraints c = load(text).scene[ObjectId{1}].constraints;
  EXPECT_EQ(c.max_speed, 0.5);
  EXPECT_EQ(c.max_tilt, 0.2);
  EXPECT_FALSE(c.may_leave_support) << "from the profile";
  EXPECT_EQ(c.touch, Touch::robot);
  EXPECT_TRUE(std::isinf(c.max_displacement));
}

TEST_F(LoadProblem, CommonNumbersAreForMovablesOnly) {
  const Problem p = load(problem_with("{profile: full}", "{max_speed: 0.5, touch: objects}"));
  EXPECT_EQ(p.profile, Profile::contact_only);
  EXPECT_EQ(p.scene[ObjectId{1}].constraints.touch, Touch::objects);
  EXPECT_EQ(p.scene[ObjectId{2}].constraints.touch, Touch::forbidden);
  EXPECT_TRUE(std::isinf(p.scene[ObjectId{2}].constraints.max_speed));
  EXPECT_EQ(p.scene[ObjectId{0}].constraints.touch, Touch::support);
}

TEST_F(LoadProblem, ContactOnlyHasNoLimitsAndLegacyThePublishedOnes) {
  const InteractionConstraints none =
      load(problem_with("profile: full", "profile: contact-only")).scene[ObjectId{1}].constraints;
  EXPECT_TRUE(std::isinf(none.max_tilt) && std::isinf(none.max_speed) && none.may_leave_support);
  const InteractionConstraints legacy =
      load(problem_with("profile: full", "profile: legacy")).scene[ObjectId{1}].constraints;
  EXPECT_NEAR(legacy.max_tilt, 38.8 * kPi / 180, 1e-15);
  EXPECT_EQ(legacy.max_speed, 0.95);
}

TEST_F(LoadProblem, ShapesOfOneBodyKeepTheirPoses) {
  const Problem p = load(problem_with("shape: {sphere: {radius: 0.04}}",
                                      "shapes: [{shape: {sphere: {radius: 0.04}}}, {shape: {box: {size: [0.1, 0.1, "
                                      "0.1]}}, pose: {position: [0, 0, 0.1]}}]"));
  ASSERT_EQ(p.scene[ObjectId{2}].shapes.size(), 2u);
  EXPECT_EQ(p.scene[ObjectId{2}].shapes[1].X_BS.translation(), Eigen::Vector3d(0, 0, 0.1));
}

TEST_F(LoadProblem, MeshesAreFoundBesideTheFileAndScaled) {
  folder.write("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Problem p = load(problem_with("{sphere: {radius: 0.04}}, pose: {position: [0.8, -0.4, 0.81]}",
                                      "{mesh: {file: tetra.obj, scale: 0.1}}, pose: {position: [0.8, -0.4, 0.77]}"));
  const Mesh& mesh = std::get<Mesh>(p.scene[ObjectId{2}].shapes[0].shape);
  EXPECT_NEAR(mesh.hull->volume, 1e-3 / 6, 1e-9);
}

TEST_F(LoadProblem, TheTargetOfAReachMustNotBeTouchedEvenIfMovable) {
  const Problem p = load(problem_with("mass: 0.2, movable: false", "mass: 0.2, movable: true"));
  EXPECT_EQ(p.scene[ObjectId{2}].constraints.touch, Touch::forbidden);
}

TEST_F(LoadProblem, AGroupOfAnSrdfPlansAndItsStatesAreStarts) {
  std::string text =
      problem_with("  base: base_footprint\n", "  group: right_arm\n  srdf: robots/pr2_right_arm.srdf\n");
  const std::size_t start = text.find("  start:"), fixed = text.find("  fixed:");
  text.replace(start, fixed - start, "  start: home\n");
  const Problem p = load(text);
  EXPECT_EQ(p.robot.dof(), 7);
  EXPECT_EQ(p.q_start[0], -1.68651);
  EXPECT_FALSE(p.robot_files.disabled.empty());
  const auto unknown = try_load(text.replace(text.find("start: home"), 11, "start: hom"));
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("'home'"));
}

TEST_F(LoadProblem, GeneratedNotesAreKeptAndEndIsRequired) {
  const Problem p = load(test::good_problem() + "generated: {seed: 7, kind: tabletop}\nend: true\n");
  EXPECT_EQ(p.generated.at("seed"), "7");
  EXPECT_EQ(p.generated.at("kind"), "tabletop");
}

TEST_F(LoadProblem, TaskOptionTurnsReachIntoRetrieveAndBack) {
  io::LoadOptions options;
  options.task = "retrieve";
  const Problem p = load(test::good_problem(), options);
  const Retrieve& retrieve = std::get<Retrieve>(p.task);
  EXPECT_EQ(retrieve.object, ObjectId{2});
  EXPECT_EQ(retrieve.home, p.q_start);
  const auto without_target = try_load(problem_with(", target: cup", ""), options);
  ASSERT_FALSE(without_target);
  EXPECT_EQ(without_target.error().kind, ErrorKind::usage);
}

TEST_F(LoadProblem, MovableGlobsMakeObjectsMovableButNeverFixtures) {
  io::LoadOptions options;
  options.movable = {"c*"};
  const Problem p = load(problem_with(", target: cup", ""), options);
  EXPECT_EQ(p.scene[ObjectId{2}].kind, ObjectKind::movable);
  EXPECT_EQ(p.scene[ObjectId{2}].constraints.touch, Touch::allowed);
  EXPECT_EQ(p.scene[ObjectId{2}].constraints.max_speed, 1.0);
  options.movable = {"tab*"};
  const auto nothing = try_load(test::good_problem(), options);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, ErrorKind::usage);
}

TEST_F(LoadProblem, DefaultMassAndFrictionFillWhatIsMissing) {
  io::LoadOptions options;
  options.default_mass = 0.7;
  options.default_friction = 0.6;
  const Problem p = load(problem_with("mass: 0.35, friction: 0.9, ", ""), options);
  EXPECT_EQ(p.scene[ObjectId{1}].mass, 0.7);
  EXPECT_EQ(p.scene[ObjectId{1}].friction, 0.6);
  options.default_mass = -1;
  EXPECT_EQ(try_load(test::good_problem(), options).error().kind, ErrorKind::usage);
}

TEST_F(LoadProblem, TheConstraintsOptionReplacesTheProfile) {
  io::LoadOptions options;
  options.constraints = "contact-only";
  const Problem p = load(test::good_problem(), options);
  EXPECT_EQ(p.profile, Profile::contact_only);
  EXPECT_TRUE(std::isinf(p.scene[ObjectId{1}].constraints.max_speed));
  options.constraints = "none";
  EXPECT_EQ(try_load(test::good_problem(), options).error().kind, ErrorKind::usage);
}

TEST_F(LoadProblem, AReplacingRobotKeepsWhatFitsAndWarnsAboutTheRest) {
  const std::string robot =
      folder.write("two.urdf", R"(<robot name="two"><link name="a"/><link name="b"/><link name="c"/>
    <joint name="r_elbow_flex_joint" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
    <joint name="other" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
      <limit lower="0.5" upper="1" velocity="1" effort="1"/></joint></robot>)");
  io::LoadOptions options;
  options.robot = robot;
  options.tip = "c";
  const Problem p = load(test::good_problem(), options);
  ASSERT_EQ(p.robot.dof(), 2);
  EXPECT_EQ(p.q_start[0], -1.0) << "moved into the limits";
  EXPECT_EQ(p.q_start[1], 0.5);
  EXPECT_GE(p.warnings.size(), 2u);
}

TEST_F(LoadProblem, AnObjectOnTheFloorOrLeaningOnAnotherDoesNotFloat) {
  EXPECT_TRUE(try_load(problem_with("[0.8, -0.4, 0.81]", "[2, 2, 0.04]")));
  EXPECT_TRUE(try_load(problem_with("[0.8, -0.4, 0.81]", "[0.7, -0.6, 0.91]"))) << "on the can";
  EXPECT_FALSE(try_load(problem_with("[0.8, -0.4, 0.81]", "[2, 2, 0.06]")));
}

}  // namespace
}  // namespace mamo
