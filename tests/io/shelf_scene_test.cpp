// The published shelf scenes: dimensions, fixtures, the heading of the goal, the robot they get.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "mamo/io/load.hpp"
#include "support/bad_inputs.hpp"
#include "support/scratch_folder.hpp"
#include "support/shared_data.hpp"

namespace mamo {
namespace {

constexpr double kPi = std::numbers::pi;

Problem load_text(const std::string& text, const io::LoadOptions& options = {}) {
  const test::ScratchFolder folder;
  Result<Problem> problem = io::load_problem(folder.write("plan_1_SCENE.txt", text), options);
  if (!problem) throw std::runtime_error(problem.error().message);
  return std::move(*problem);
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = test::good_shelf_scene();
  return text.replace(text.find(from), from.size(), to);
}

double heading(const Eigen::Isometry3d& X) { return std::atan2(X.linear()(1, 0), X.linear()(0, 0)); }

TEST(ShelfScene, BoxesGiveHalfSizesAndCylindersRadiusAndFullHeight) {
  const Problem p = load_text(test::good_shelf_scene());
  ASSERT_EQ(p.scene.size(), 7u);
  EXPECT_EQ(std::get<Box>(p.scene[p.scene.find("1")].shapes[0].shape).size, Eigen::Vector3d(0.6, 0.8, 0.04));
  EXPECT_EQ(std::get<Box>(p.scene[p.scene.find("7")].shapes[0].shape).size, Eigen::Vector3d(0.06, 0.1, 0.2));
  const Cylinder& c = std::get<Cylinder>(p.scene[p.scene.find("6")].shapes[0].shape);
  EXPECT_EQ(c.radius, 0.035);
  EXPECT_EQ(c.length, 0.16);
}

TEST(ShelfScene, FixtureOneIsTheSupportTheOthersAreForbiddenAndOpenUnderLegacy) {
  const Problem full = load_text(test::good_shelf_scene());
  EXPECT_EQ(full.profile, Profile::full);
  EXPECT_EQ(full.scene[full.scene.find("1")].constraints.touch, Touch::support);
  io::LoadOptions options;
  options.constraints = "legacy";
  const Problem legacy = load_text(test::good_shelf_scene(), options);
  for (const char* wall : {"2", "3", "4", "5"}) {
    EXPECT_EQ(full.scene[full.scene.find(wall)].constraints.touch, Touch::forbidden);
    EXPECT_EQ(legacy.scene[legacy.scene.find(wall)].constraints.touch, Touch::objects);
    EXPECT_TRUE(full.scene[full.scene.find(wall)].fixture());
  }
}

TEST(ShelfScene, KindsMassesAndFrictionAreThoseOfTheFile) {
  const Problem p = load_text(test::good_shelf_scene());
  const Object &six = p.scene[p.scene.find("6")], &seven = p.scene[p.scene.find("7")];
  EXPECT_EQ(six.kind, ObjectKind::immovable);
  EXPECT_EQ(six.mass, 0.25);
  EXPECT_EQ(six.friction, 0.9);
  EXPECT_EQ(six.constraints.touch, Touch::forbidden);
  EXPECT_EQ(seven.kind, ObjectKind::movable);
  EXPECT_EQ(seven.mass, 0.2);
  EXPECT_NEAR(seven.constraints.max_tilt, 25 * kPi / 180, 1e-15);
  EXPECT_NEAR(heading(seven.X_WO), 1.5, 1e-12);
}

TEST(ShelfScene, TheRobotIsTheShippedPr2AtHomeWhateverSectionSSays) {
  const Problem p = load_text(test::good_shelf_scene());
  ASSERT_EQ(p.robot.dof(), 7);
  EXPECT_EQ(p.robot.joint(0).name, "r_shoulder_pan_joint");
  Eigen::VectorXd home(7);
  home << -1.68651, -0.184315, -1.67611, -1.66215, 0.285096, -0.658798, 1.41563;
  EXPECT_EQ(p.q_start, home);
  const auto value = [&](const char* joint) {
    return p.robot.posture[p.robot.model->joints[p.robot.model->find_joint(joint).index()].variable];
  };
  EXPECT_EQ(value("torso_lift_joint"), 0.1);
  EXPECT_EQ(value("r_gripper_l_finger_joint"), 0.2);
  EXPECT_NEAR(value("l_shoulder_pan_joint"), kPi / 2, 1e-6);
  EXPECT_NEAR(value("l_elbow_flex_joint"), -kPi / 4, 1e-6);
  EXPECT_EQ(p.robot.model->links[p.robot.group.tip.index()].name, "r_gripper_finger_dummy_planning_link");
  EXPECT_EQ(p.robot.X_WB.matrix(), Eigen::Matrix4d::Identity());
}

TEST(ShelfScene, TheTaskIsRetrieveOrOnRequestTheReachOfThePregraspPose) {
  const Problem p = load_text(test::good_shelf_scene());
  const Retrieve& retrieve = std::get<Retrieve>(p.task);
  EXPECT_EQ(retrieve.object, p.scene.find("6"));
  EXPECT_EQ(retrieve.home, p.q_start);
  io::LoadOptions options;
  options.task = "reach";
  const Problem q = load_text(test::good_shelf_scene(), options);
  const ReachPose& reach = std::get<ReachPose>(q.task);
  EXPECT_EQ(reach.X_WT.matrix(), retrieve.X_WT_pregrasp.matrix());
  EXPECT_EQ(reach.X_WT.translation(), Eigen::Vector3d(0.82, -0.4, 0.85));
  EXPECT_EQ(reach.target, retrieve.object);
}

TEST(ShelfScene, AFlippedGoalPointsTheOtherWayAndStandsUpright) {
  const Problem plain = load_text(with("0.85,0,0,0\nooi", "0.85,0.4,0,0\nooi"));
  EXPECT_NEAR(heading(std::get<Retrieve>(plain.task).X_WT_pregrasp), 0.4, 1e-12);
  const Problem flipped = load_text(with("0.85,0,0,0\nooi", "0.85,-2.9,-3.14159,3.14159\nooi"));
  const Eigen::Isometry3d& X = std::get<Retrieve>(flipped.task).X_WT_pregrasp;
  EXPECT_NEAR(heading(X), kPi - 2.9, 1e-12);
  EXPECT_NEAR(X.linear()(2, 2), 1, 1e-12);
}

TEST(ShelfScene, OddScenesAreReportedAndLoad) {
  const auto warnings = [](const std::string& from, const std::string& to) {
    return ::testing::PrintToString(load_text(with(from, to)).warnings);
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(warnings("0.82,-0.4,0.85", "0.6,-0.4,0.85"), HasSubstr("0.3 m from the object of interest"));
  EXPECT_THAT(warnings("0.035,0.035", "0.035,0.04"), HasSubstr("sx and sy"));
  EXPECT_THAT(warnings("0.7,-0.6,0.87", "0.7,-0.6,0.95"), HasSubstr("'7' floats"));
  EXPECT_THAT(warnings("0.2,0.8,True", "0,0.8,True"), HasSubstr("has no mass"));
  EXPECT_THAT(warnings("7,0,1,", "7,0,0,"), HasSubstr("type of object '7'"));
  EXPECT_EQ(load_text(test::good_shelf_scene()).warnings.size(), 0u);
}

TEST(ShelfScene, WindowsLineEndsAndSpacesDoNotMatter) {
  std::string text;
  for (char c : test::good_shelf_scene()) text += c == '\n' ? std::string(" \r\n") : std::string(1, c);
  EXPECT_EQ(load_text(text).scene.size(), 7u);
}

/// The published scenes, every one of them that is there.
TEST(ShelfScene, AllPublishedScenesLoadAndPointAtTheirTarget) {
  MAMO_SHARED_OR_SKIP(folder, "em4m_scenes");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().filename().string().ends_with("_SCENE.txt")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 100u);
  int with_warnings = 0;
  for (const auto& file : files) {
    const Result<Problem> loaded = io::load_problem(file.string());
    ASSERT_TRUE(loaded) << loaded.error().message;
    with_warnings += !loaded->warnings.empty();
    for (const std::string& w : loaded->warnings) EXPECT_THAT(w, ::testing::HasSubstr("usually it is within"));
    const Retrieve& task = std::get<Retrieve>(loaded->task);
    const Object& target = loaded->scene[task.object];
    EXPECT_EQ(target.kind, ObjectKind::immovable);
    const Eigen::Vector3d ahead = target.X_WO.translation() - task.X_WT_pregrasp.translation();
    const double off = std::atan2(ahead.y(), ahead.x()) - heading(task.X_WT_pregrasp);
    EXPECT_LT(std::abs(std::remainder(off, 2 * kPi)), 0.02) << file << ": the gripper looks at its target";
    int movables = 0;
    for (const Object& o : loaded->scene.objects) movables += o.movable();
    EXPECT_EQ(std::to_string(movables), file.parent_path().filename().string()) << "movables, as the folder says";
  }
  RecordProperty("scenes", static_cast<int>(files.size()));
  RecordProperty("with_warnings", with_warnings);
  std::printf("%zu scenes, %d with warnings\n", files.size(), with_warnings);
}

TEST(ShelfScene, ThePublishedPr2ReplacesTheShippedOne) {
  MAMO_SHARED_OR_SKIP(urdf, "robots/pr2/pr2.urdf");
  io::LoadOptions options;
  options.robot = urdf;
  const Problem p = load_text(test::good_shelf_scene(), options);
  EXPECT_EQ(p.robot.dof(), 7);
  EXPECT_EQ(p.q_start[0], -1.68651);
}

}  // namespace
}  // namespace mamo
