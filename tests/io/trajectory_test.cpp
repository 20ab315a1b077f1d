#include "mamo/io/trajectory.hpp"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "support/sample_problem.hpp"

namespace mamo {
namespace {

class Trajectory : public ::testing::Test {
 protected:
  Problem problem = fixtures::sample_problem();
  Plan plan = fixtures::sample_plan(problem);
};

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

TEST_F(Trajectory, CsvHasAHeaderAndOneRowPerPointWithTheSeamOnce) {
  const auto csv = io::trajectory_csv(plan, problem);
  ASSERT_TRUE(csv) << csv.error().message;
  const auto rows = rows_of(*csv);
  ASSERT_EQ(rows.size(), 1u + 4u);  // 3 points and 2, of which one is shared
  ASSERT_EQ(rows[0].size(), 8u);
  EXPECT_EQ(rows[0][0], "time");
  EXPECT_EQ(rows[0][1], "shoulder_pan");
  EXPECT_EQ(rows[0][7], "wrist_roll");
}

TEST_F(Trajectory, CsvNumbersReadBackAsTheSameDoubles) {
  const auto rows = rows_of(io::trajectory_csv(plan, problem).value());
  EXPECT_EQ(std::stod(rows[1][0]), 0.0);
  EXPECT_EQ(std::stod(rows[3][0]), 0.1 + 0.7);
  EXPECT_EQ(std::stod(rows[4][0]), (0.1 + 0.7) + 1.0 / 3.0);
  EXPECT_EQ(std::stod(rows[4][1]), problem.q_start[0] + 1.0 / 3.0);
  EXPECT_EQ(std::stod(rows[4][2]), problem.q_start[1]);
}

TEST_F(Trajectory, TimesIncreaseStrictlyOverTheWholePlan) {
  const auto joined = io::join_segments(plan, problem);
  ASSERT_TRUE(joined);
  for (std::size_t i = 1; i < joined->motion.t.size(); ++i) EXPECT_GT(joined->motion.t[i], joined->motion.t[i - 1]);
  EXPECT_EQ(joined->motion.t.front(), 0.0);
}

TEST_F(Trajectory, JointsASegmentDoesNotNameKeepTheirValue) {
  Segment& push = plan.segments[1];
  push.joint_names = {"shoulder_pan"};
  for (auto& q : push.motion.q) q = Eigen::VectorXd(q.head(1));
  const auto joined = io::join_segments(plan, problem);
  ASSERT_TRUE(joined) << joined.error().message;
  EXPECT_EQ(joined->motion.q.back()[6], problem.q_start[6]);
  EXPECT_EQ(joined->motion.q.back()[0], problem.q_start[0] + 1.0 / 3.0);
}

TEST_F(Trajectory, AJumpBetweenSegmentsIsAnError) {
  plan.segments[1].motion.q[0][2] += 0.01;
  const auto joined = io::join_segments(plan, problem);
  ASSERT_FALSE(joined);
  EXPECT_THAT(joined.error().message, ::testing::HasSubstr("segment 1"));
}

TEST_F(Trajectory, AnEmptyPlanAndAnUnknownJointAreErrors) {
  EXPECT_FALSE(io::trajectory_csv(Plan{}, problem));
  plan.segments[0].joint_names[3] = "no_such_joint";
  const auto csv = io::trajectory_csv(plan, problem);
  ASSERT_FALSE(csv);
  EXPECT_THAT(csv.error().message, ::testing::HasSubstr("no_such_joint"));
}

TEST_F(Trajectory, JointTrajectoryYamlHasTheRosFields) {
  const auto text = io::joint_trajectory_yaml(plan, problem);
  ASSERT_TRUE(text);
  const YAML::Node root = YAML::Load(*text);
  EXPECT_EQ(root["header"]["frame_id"].as<std::string>(), "base");
  ASSERT_EQ(root["joint_names"].size(), 7u);
  ASSERT_EQ(root["points"].size(), 4u);
  EXPECT_EQ(root["points"][0]["time_from_start"]["sec"].as<int>(), 0);
  EXPECT_EQ(root["points"][0]["time_from_start"]["nanosec"].as<int>(), 0);
  const YAML::Node last = root["points"][3];
  EXPECT_EQ(last["time_from_start"]["sec"].as<int>(), 1);
  EXPECT_EQ(last["time_from_start"]["nanosec"].as<int>(), 133333333);
  EXPECT_EQ(last["positions"][0].as<double>(), problem.q_start[0] + 1.0 / 3.0);
  EXPECT_TRUE(last["velocities"].IsSequence());
}

TEST_F(Trajectory, Ros1SpellsTimesItsOwnWay) {
  const YAML::Node root = YAML::Load(io::joint_trajectory_yaml(plan, problem, true).value());
  EXPECT_EQ(root["points"][1]["time_from_start"]["nsecs"].as<int>(), 500000000);
  EXPECT_EQ(root["header"]["stamp"]["secs"].as<int>(), 0);
  EXPECT_FALSE(root["points"][1]["time_from_start"]["sec"]);
}

TEST_F(Trajectory, JointTrajectoryYamlNamesThePredictedPosesInComments) {
  EXPECT_THAT(io::joint_trajectory_yaml(plan, problem).value(), ::testing::HasSubstr("#   object_0: ["));
}

}  // namespace
}  // namespace mamo
