// Retrieving: approach beside the object, close on it, lift it off the table, bring it home.
#include "support/table_world.hpp"
#include "support/verdicts.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class Retrieval : public testing::Test {
 protected:
  Retrieval() {
    problem.q_start = problem.robot.posture = over_table(-0.6, -0.45);
    problem.scene.objects.push_back(can_at("soup", 0.0, ObjectKind::immovable));
    Retrieve task;
    task.object = soup;
    task.home = problem.q_start;
    problem.task = task;
    plan = path();
  }

  /// Home is at pan -0.6, high above the table; the can stands at pan 0. The fingers stop 3 cm beside it, then close
  /// on it sideways.
  Plan path(double grasp_pan = 0.0) const {
    const Eigen::VectorXd home = problem.q_start, beside = over_table(grasp_pan - 0.13),
                          at_object = over_table(grasp_pan), lifted = over_table(grasp_pan, -0.45);
    Plan made;
    made.segments = {motion(problem, {home, over_table(grasp_pan - 0.13, -0.45), beside}, SegmentKind::approach),
                     motion(problem, {beside, at_object}, SegmentKind::grasp),
                     motion(problem, {at_object, lifted, home}, SegmentKind::extract)};
    for (Segment& segment : made.segments) segment.object = soup;
    return made;
  }

  Problem problem = table_problem();
  const ObjectId soup{1};
  Plan plan;
};

TEST_F(Retrieval, HoldsAndTheObjectIsWhereTheArmBroughtIt) {
  const Verdict verdict = judge(problem, plan);
  ASSERT_TRUE(holds(verdict));
  // Rigidly with the tool from the grasp to home.
  const ForwardKinematics kinematics(problem.robot);
  const Eigen::Isometry3d X_TO =
      kinematics.tip_pose(over_table(0.0)).inverse() * problem.scene.objects[soup.index()].X_WO;
  const Eigen::Isometry3d expected = kinematics.tip_pose(problem.q_start) * X_TO;
  EXPECT_LT((verdict.objects_after[2].at(soup).translation() - expected.translation()).norm(), 1e-4);
  EXPECT_LT(
      (verdict.objects_after[1].at(soup).translation() - problem.scene.objects[soup.index()].X_WO.translation()).norm(),
      1e-4);
}

TEST_F(Retrieval, WithoutAGraspSegmentTouchingIsForbidden) {
  for (Segment& segment : plan.segments) segment.kind = SegmentKind::reach;
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::robot_touch, 1));
}

TEST_F(Retrieval, NothingHeldAtTheEndIsNotDone) {
  plan.segments = {plan.segments[0], motion(problem, {over_table(-0.13), over_table(-0.13, -0.45), problem.q_start},
                                            SegmentKind::retreat)};
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::task_not_done, 1));
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("not held"));
}

TEST_F(Retrieval, TouchingTheObjectBeforeTheGraspIsAViolation) {
  plan.segments[0] = motion(problem, {problem.q_start, over_table(-0.03)}, SegmentKind::approach);
  plan.segments[1] = motion(problem, {over_table(-0.03), over_table(0.0)}, SegmentKind::grasp);
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::robot_touch, 0));
}

TEST_F(Retrieval, AGraspFarFromTheObjectHoldsNothing) {
  plan = path(-0.3);
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::task_not_done, 1));
  EXPECT_EQ(verdict.findings[0].violation.object, soup);
}

TEST_F(Retrieval, HomeMustBeReached) {
  for (Eigen::VectorXd& q : plan.segments[2].motion.q)
    if (q == problem.q_start) q[0] += 0.02;
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::task_not_done, 2));
}

TEST_F(Retrieval, AnotherObjectOrASecondGraspIsMalformed) {
  problem.scene.objects.push_back(can_at("other", 0.5));
  Plan changed = plan;
  changed.segments[1].object = ObjectId{2};
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
  changed = plan;
  changed.segments[2].kind = SegmentKind::grasp;
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 2));
}

TEST_F(Retrieval, TheHeldObjectCountsAsRobot) {
  // A low thing beyond the fingers' reach but in the way of the can's lower end, once the can is dragged.
  const auto drag = [&] {
    Plan made = path();
    made.segments[2] =
        motion(problem, {over_table(0.0), over_table(0.0, -0.33), over_table(0.3, -0.33)}, SegmentKind::extract);
    return made;
  };
  std::get<Retrieve>(problem.task).home = over_table(0.3, -0.33);
  ASSERT_TRUE(holds(judge(problem, drag())));
  const Eigen::Vector2d p = hand_at(0.15);
  const Object low = standing_cylinder("low", p.x(), p.y(), 0.03, 0.05, ObjectKind::immovable);  // up to 0.82
  problem.scene.objects.push_back(low);
  Verdict verdict = judge(problem, drag());
  ASSERT_TRUE(rejects(verdict, ViolationKind::robot_touch, 2));
  EXPECT_EQ(verdict.findings[0].violation.object, ObjectId{2});
  // Static: the simulator sees no contact between what is driven and what never moves.
  problem.scene.objects.back().mass = 0;
  verdict = judge(problem, drag());
  ASSERT_TRUE(rejects(verdict, ViolationKind::robot_touch, 2));
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("the held soup"));
  // A movable one is pushed.
  problem.scene.objects.back() = standing_cylinder("low", p.x(), p.y(), 0.03, 0.05, ObjectKind::movable, 0.2, 0.2);
  verdict = judge(problem, drag());
  EXPECT_TRUE(holds(verdict));
  ASSERT_FALSE(verdict.interactions.empty());
  EXPECT_EQ(verdict.interactions.back().b, ObjectId{2});
}

TEST_F(Retrieval, TheHeldObjectMayTouchItsSupportUntilItClearsItAndNotAgain) {
  // Dragged along the table without lifting: it may.
  Plan drag = path();
  drag.segments[2] = motion(problem, {over_table(0.0), over_table(0.2)}, SegmentKind::extract);
  std::get<Retrieve>(problem.task).home = over_table(0.2);
  EXPECT_TRUE(holds(judge(problem, drag)));
  // Lifted and put down again, deeper than it stood: a touch.
  drag.segments[2] =
      motion(problem, {over_table(0.0), over_table(0.0, -0.35), over_table(0.0, -0.298)}, SegmentKind::extract);
  std::get<Retrieve>(problem.task).home = over_table(0.0, -0.298);
  Verdict verdict = judge(problem, drag);
  EXPECT_TRUE(rejects(verdict, ViolationKind::robot_touch, 2));
  EXPECT_EQ(verdict.findings[0].violation.object, ObjectId{0});
  // Pressed into the table at once: beyond what counts as resting.
  drag.segments[2] = motion(problem, {over_table(0.0), over_table(0.0, -0.285)}, SegmentKind::extract);
  std::get<Retrieve>(problem.task).home = over_table(0.0, -0.285);
  verdict = judge(problem, drag);
  EXPECT_TRUE(rejects(verdict, ViolationKind::robot_touch, 2));
}

TEST_F(Retrieval, TheGraspAtTheVeryEndStillHolds) {
  plan.segments.pop_back();
  std::get<Retrieve>(problem.task).home = over_table(0.0);
  EXPECT_TRUE(holds(judge(problem, plan)));
}

}  // namespace
}  // namespace mamo
