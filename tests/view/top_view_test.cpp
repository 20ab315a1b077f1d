#include "mamo/view/top_view.hpp"

#include <cstdlib>
#include <fstream>

#include "mamo/view/describe.hpp"
#include "support/fixtures.hpp"

namespace mamo::view {
namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

Problem shelf_problem(int movables = 8, int immovables = 3) {
  Problem problem;
  problem.name = "shelf <8 & 3>.yaml";
  problem.robot = fixtures::pr2_like_arm();
  problem.scene = fixtures::cluttered_shelf(movables, immovables, 3);
  problem.q_start = problem.robot.group_part(problem.robot.posture);
  ReachPose reach;
  reach.X_WT = fixtures::at(0.72, -0.45, 0.9, 0.3);
  problem.task = reach;
  return problem;
}

/// A reach and a push that move object_0 by 12 cm.
Plan two_segments(const Problem& problem) {
  Plan plan;
  Eigen::VectorXd q = problem.q_start;
  for (const SegmentKind kind : {SegmentKind::approach, SegmentKind::push, SegmentKind::retreat}) {
    Segment segment;
    segment.kind = kind;
    for (int i = 0; i < problem.robot.dof(); ++i) segment.joint_names.push_back(problem.robot.joint(i).name);
    Eigen::VectorXd next = q;
    next[0] += kind == SegmentKind::approach ? 0.7 : kind == SegmentKind::push ? 0.35 : -0.1;
    next[3] += kind == SegmentKind::approach ? 0.9 : kind == SegmentKind::push ? 0.3 : -0.25;
    segment.motion = time_path(problem.robot, {q, next}, problem.scene.physics.step);
    q = next;
    plan.segments.push_back(segment);
  }
  const ObjectId id = problem.scene.find("object_0");
  plan.segments[1].object = id;
  plan.segments[1].objects_after[id] = fixtures::at(0.12, 0.05, 0) * problem.scene[id].X_WO;
  return plan;
}

TEST(TopView, NamesEveryObjectAndEscapesTheTitle) {
  const Problem problem = shelf_problem();
  const std::string svg = top_view_svg(problem);
  for (const Object& object : problem.scene.objects)
    if (!object.fixture()) {
      EXPECT_GE(count(svg, ">" + object.id + "</text>"), 1u) << object.id;
    }
  EXPECT_EQ(count(svg, "shelf <8"), 0u);
  EXPECT_GE(count(svg, "shelf &lt;8 &amp; 3&gt;.yaml"), 1u);
  EXPECT_EQ(count(svg, "nan"), 0u);
}

TEST(TopView, WithoutAPlanNothingMoves) {
  const std::string svg = top_view_svg(shelf_problem());
  EXPECT_EQ(count(svg, "class=\"was\""), 0u);
  EXPECT_EQ(count(svg, "class=\"arm1\""), 0u);
  EXPECT_EQ(count(svg, "class=\"tip "), 0u);
}

TEST(TopView, APlanShowsItsSegmentsTheArmAtItsEndAndWhatItMoves) {
  const Problem problem = shelf_problem();
  const Plan plan = two_segments(problem);
  const std::string svg = top_view_svg(problem, &plan);
  for (const char* kind : {"approach", "push", "retreat"})
    EXPECT_EQ(count(svg, std::string("class=\"tip ") + kind + "\""), 2u) << kind;  // the path and the legend
  EXPECT_EQ(count(svg, "class=\"was\""), 2u);    // the object and the legend
  EXPECT_EQ(count(svg, "class=\"moved\""), 2u);
  EXPECT_EQ(count(svg, "class=\"arrow\""), 1u);
  EXPECT_GE(count(svg, "class=\"arm1\""), 2u);
}

TEST(TopView, TheSameInputsGiveTheSameBytes) {
  const Problem problem = shelf_problem();
  const Plan plan = two_segments(problem);
  EXPECT_EQ(top_view_svg(problem, &plan), top_view_svg(problem, &plan));
}

TEST(TopView, APlanForAnotherRobotDrawsNoPathAndDoesNotFail) {
  const Problem problem = shelf_problem();
  Plan plan = two_segments(problem);
  for (Segment& segment : plan.segments) segment.joint_names[0] = "no_such_joint";
  const std::string svg = top_view_svg(problem, &plan);
  EXPECT_EQ(count(svg, "class=\"tip "), 0u);
}

TEST(TopView, AnEmptySceneIsDrawn) {
  Problem problem = shelf_problem();
  problem.scene = {};
  EXPECT_GE(count(top_view_svg(problem), "class=\"arm0\""), 2u);
}

TEST(TopView, WritesAPictureOnRequest) {
  const char* path = std::getenv("MAMO_WRITE_TOP_VIEW");  // to look at it: rsvg-convert FILE -o FILE.png
  if (!path) GTEST_SKIP() << "MAMO_WRITE_TOP_VIEW names no file";
  const Problem problem = shelf_problem(12, 4);
  const Plan plan = two_segments(problem);
  std::ofstream(path) << top_view_svg(problem, &plan);
}

TEST(Describe, AProblemNamesRobotJointsObjectsTaskAndProfile) {
  Problem problem = shelf_problem();
  problem.warnings = {"a visual mesh is missing"};
  const std::string text = describe(problem);
  for (const char* piece : {"pr2_like", "7 joints plan", "shoulder_pan", "continuous", "tip tool", "10 pairs", "object_0",
                            "support", "movable", "task reach", "contact-only", "warning: a visual mesh is missing"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
}

TEST(Describe, APlanTellsItsSegmentsAndWhatMoves) {
  const Problem problem = shelf_problem();
  const std::string text = describe(two_segments(problem), problem);
  for (const char* piece : {"3 segments", "approach", "push", "object_0", "moves object_0 by 0.130 m"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
}

}  // namespace
}  // namespace mamo::view
