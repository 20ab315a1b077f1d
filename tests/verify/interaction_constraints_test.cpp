// Every constraint on objects, broken by a plan made for it, and kept by one that comes close.
#include "support/table_world.hpp"
#include "support/verdicts.hpp"

#include "mamo/physics/world.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class InteractionConstraintsOf : public testing::Test {
 protected:
  Object& add(const Object& object) {
    problem.scene.objects.push_back(object);
    return problem.scene.objects.back();
  }
  ObjectId id(const std::string& name) const { return problem.scene.find(name); }
  Verdict run() { return judge(problem, sweep(problem, {0.0})); }

  Problem problem = table_problem(0.0);  // the hand sweeps from -0.6 to 0
};

TEST_F(InteractionConstraintsOf, PushingAMovableHoldsAndIsAnInteraction) {
  add(can_at("can", -0.15));
  add(can_at("bystander", 0.3));
  const Verdict verdict = run();
  EXPECT_TRUE(holds(verdict));
  ASSERT_EQ(verdict.interactions.size(), 1u);
  EXPECT_EQ(verdict.interactions[0].a, kRobot);
  EXPECT_EQ(verdict.interactions[0].b, id("can"));
  ASSERT_EQ(verdict.objects_after.size(), 1u);
  const auto moved = [&](const std::string& name) {
    return (verdict.objects_after[0].at(id(name)).translation() - problem.scene[id(name)].X_WO.translation()).norm();
  };
  EXPECT_GT(moved("can"), 0.1);
  EXPECT_LT(moved("bystander"), 1e-5);  // untouched: only the rounding of the start
}

TEST_F(InteractionConstraintsOf, AChainOfPushedObjectsIsInTheInteractions) {
  add(can_at("a", -0.25));
  add(can_at("b", -0.13));
  const Verdict verdict = run();
  EXPECT_TRUE(holds(verdict));
  std::vector<std::pair<ObjectId, ObjectId>> pairs;
  for (const Interaction& i : verdict.interactions) pairs.emplace_back(i.a, i.b);
  EXPECT_THAT(pairs, testing::Contains(std::pair(kRobot, id("a"))));
  EXPECT_THAT(pairs, testing::Contains(std::pair(id("a"), id("b"))));
  EXPECT_TRUE(std::is_sorted(verdict.interactions.begin(), verdict.interactions.end(),
                             [](const auto& x, const auto& y) { return x.first_time_s < y.first_time_s; }));
}

TEST_F(InteractionConstraintsOf, RobotTouchOfAnImmovable) {
  add(can_at("vase", -0.15, ObjectKind::immovable));
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::robot_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("vase"));
  EXPECT_GT(verdict.findings[0].violation.time_s, 1);
}

TEST_F(InteractionConstraintsOf, RobotTouchOfAMovableThatOnlyObjectsMayTouch) {
  add(can_at("can", -0.15)).constraints.touch = Touch::objects;
  EXPECT_TRUE(rejects(run(), ViolationKind::robot_touch));
}

TEST_F(InteractionConstraintsOf, ObjectTouchOfAnImmovableByAMovable) {
  add(can_at("can", -0.25));
  add(can_at("vase", -0.13, ObjectKind::immovable));
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::object_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("vase"));
  EXPECT_EQ(verdict.findings[0].violation.other, id("can"));
  EXPECT_EQ(verdict.interactions.back().b, id("vase"));  // learned up to the violation
  problem.scene.objects[id("vase").index()].constraints.touch = Touch::objects;
  EXPECT_FALSE(rejects(run(), ViolationKind::object_touch));
}

TEST_F(InteractionConstraintsOf, ObjectTouchOfAWallThatIsForbidden) {
  add(can_at("can", -0.25));
  const Eigen::Vector2d p = hand_at(-0.12);
  add(fixture_box("wall", {p.x() + 0.05, p.y(), 0.8}, {0.2, 0.02, 0.04}, Touch::forbidden));  // below the fingers
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::object_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("can"));
  EXPECT_EQ(verdict.findings[0].violation.other, id("wall"));
}

TEST_F(InteractionConstraintsOf, PairsInContactAtTheStartMayStay) {
  // Two cans touch one another, which neither may; the robot pushes one of them away from the other.
  const Object a = can_at("a", -0.15);
  Object b = a;
  b.id = "b";
  b.X_WO.translation().y() -= 0.0;
  b.X_WO.translation().x() += 0.07;
  add(a).constraints.touch = Touch::robot;
  add(b).constraints.touch = Touch::robot;
  EXPECT_TRUE(holds(run()));
  // Apart by a centimetre at the start and pushed together: a new touch.
  problem.scene.objects[id("a").index()].X_WO = can_at("a", -0.25).X_WO;
  problem.scene.objects[id("b").index()].X_WO = can_at("b", -0.15).X_WO;
  EXPECT_TRUE(rejects(run(), ViolationKind::object_touch));
}

TEST_F(InteractionConstraintsOf, TheTargetOfAReachMustNotBeTouched) {
  add(can_at("cup", -0.15));
  ReachPose reach;
  reach.X_WT = ForwardKinematics(problem.robot).tip_pose(over_table(0.0));
  problem.task = reach;
  EXPECT_TRUE(holds(run()));
  reach.target = id("cup");
  problem.task = reach;
  EXPECT_TRUE(rejects(run(), ViolationKind::robot_touch));
}

TEST_F(InteractionConstraintsOf, TheTargetOfAReachMustNotBeTouchedByObjectsEither) {
  add(can_at("can", -0.25));
  add(can_at("cup", -0.13));
  ReachPose reach;
  reach.X_WT = ForwardKinematics(problem.robot).tip_pose(over_table(0.0));
  reach.target = id("cup");
  problem.task = reach;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::object_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("cup"));
}

TEST_F(InteractionConstraintsOf, Tilt) {
  Object& can = add(can_at("can", -0.15, ObjectKind::movable, 0.18, 1.0));  // tall and rough: it topples
  can.constraints.max_tilt = 25 * std::numbers::pi / 180;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::tilt));
  EXPECT_GT(verdict.findings[0].violation.value, can.constraints.max_tilt);
  EXPECT_LT(verdict.findings[0].violation.value, can.constraints.max_tilt + 0.1);  // found within a step or two
}

TEST_F(InteractionConstraintsOf, TiltCountsFromTheAxisThatWasUpAndNotTheYaw) {
  Object& can = add(can_at("can", -0.15));
  // The same can, modelled lying on its side in its own frame: what is up at the start counts.
  can.shapes[0].X_BS = lying(0, 0, 0);
  can.X_WO.linear() = lying(0, 0, 0).linear().transpose();
  can.constraints.max_tilt = 25 * std::numbers::pi / 180;
  const Verdict verdict = run();
  EXPECT_TRUE(holds(verdict));
  EXPECT_EQ(verdict.interactions.size(), 1u);
}

TEST_F(InteractionConstraintsOf, Speed) {
  Object& can = add(can_at("can", -0.15));
  can.constraints.max_speed = 0.1;  // the hand runs at 0.2 m/s
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::speed));
  EXPECT_GT(verdict.findings[0].violation.value, 0.1);
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("m/s"));
  problem.scene.objects[id("can").index()].constraints.max_speed = 1;
  EXPECT_TRUE(holds(run()));
}

TEST_F(InteractionConstraintsOf, Displacement) {
  add(can_at("can", -0.15)).constraints.max_displacement = 0.05;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::displacement));
  EXPECT_NEAR(verdict.findings[0].violation.value, 0.05, 0.005);
}

TEST_F(InteractionConstraintsOf, AnImmovableMustNotMoveWhoeverMayTouchIt) {
  add(can_at("vase", -0.15, ObjectKind::immovable)).constraints.touch = Touch::allowed;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::immovable_moved));
  EXPECT_NEAR(verdict.findings[0].violation.value, 0.01, 0.005);
}

TEST_F(InteractionConstraintsOf, LeavingTheSupportSideways) {
  // A narrow table under the can; beside it a lower one, so that it hangs over the edge before it falls.
  const Eigen::Vector2d p = hand_at(-0.15);
  problem.scene.objects[0] = fixture_box("table", {p.x(), p.y(), 0.75}, {0.3, 0.14, 0.04}, Touch::support);
  add(can_at("can", -0.15)).constraints.may_leave_support = false;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::left_support));
  EXPECT_EQ(verdict.findings[0].violation.object, id("can"));
  EXPECT_GT(verdict.findings[0].violation.value, 0);
}

TEST_F(InteractionConstraintsOf, ATableBelowIsNoSupport) {
  const Eigen::Vector2d p = hand_at(-0.15);
  problem.scene.objects[0] = fixture_box("table", {p.x(), p.y(), 0.75}, {0.3, 0.14, 0.04}, Touch::support);
  add(fixture_box("lower", {0.85, -0.1, 0.6}, {1, 1, 0.02}, Touch::support));
  add(can_at("can", -0.15)).constraints.may_leave_support = false;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::left_support));
}

TEST_F(InteractionConstraintsOf, ACanOnItsSideHasNotLeftItsSupport) {
  Object& can = add(can_at("can", -0.15, ObjectKind::movable, 0.18, 1.0));
  can.constraints.may_leave_support = false;
  problem.scene.physics.settle_time = 20;  // it may roll for a while
  EXPECT_FALSE(rejects(run(), ViolationKind::left_support));
}

TEST_F(InteractionConstraintsOf, OntoAnotherSupportOfTheSameHeightIsNotLeft) {
  const Eigen::Vector2d p = hand_at(-0.15);
  problem.scene.objects[0] = fixture_box("table", {p.x(), p.y() - 0.13, 0.75}, {0.4, 0.4, 0.04}, Touch::support);
  add(fixture_box("next", {p.x(), p.y() + 0.27, 0.75}, {0.4, 0.4, 0.04}, Touch::support));
  add(can_at("can", -0.15)).constraints.may_leave_support = false;
  EXPECT_TRUE(holds(run()));
  // The same place taken by a fixture that is no support.
  problem.scene.objects[id("next").index()].constraints.touch = Touch::objects;
  EXPECT_TRUE(rejects(run(), ViolationKind::left_support));
}

TEST_F(InteractionConstraintsOf, PenetrationOfWhatIsPressedOntoTheTable) {
  add(can_at("can", 0.0));  // its top is at 0.87
  problem.q_start = problem.robot.posture = over_table(0.0, -0.5);
  Plan plan;
  plan.segments.push_back(motion(problem, {problem.q_start, over_table(0.0)}));  // fingers down to 0.84
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::penetration)) << report(verdict);
  EXPECT_GT(verdict.findings[0].violation.value, 0.005);
  EXPECT_EQ(verdict.findings[0].violation.object, id("can"));
}

TEST_F(InteractionConstraintsOf, WhatStillMovesAtTheSettleLimitIsNotAtRest) {
  add(can_at("puck", -0.1, ObjectKind::movable, 0.08, 0.0));  // no friction: it slides on
  problem.scene.physics.settle_time = 0.3;
  const Verdict verdict = run();
  EXPECT_TRUE(rejects(verdict, ViolationKind::not_at_rest));
  EXPECT_GT(verdict.findings[0].violation.value, kRestSpeed);
}

TEST_F(InteractionConstraintsOf, TheSettlingAfterTheLastPointIsJudgedToo) {
  Object& puck = add(can_at("puck", -0.1, ObjectKind::movable, 0.08, 0.02));  // it slides on for 10 cm
  const Plan plan = sweep(problem, {0.0});
  Verdict verdict = judge(problem, plan);
  ASSERT_TRUE(holds(verdict));
  const Eigen::Vector3d end = verdict.objects_after[0].at(id("puck")).translation();
  puck.constraints.max_displacement = (end - puck.X_WO.translation()).norm() - 0.01;
  verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::displacement));
  EXPECT_GT(verdict.findings[0].violation.time_s, plan.segments[0].motion.duration());
}

TEST_F(InteractionConstraintsOf, WaitsOfThePlanCount) {
  add(can_at("can", -0.15));
  Plan plan = sweep(problem, {0.0});
  plan.segments[0].motion.t.push_back(plan.segments[0].motion.duration() + 1.0);
  plan.segments[0].motion.q.push_back(plan.segments[0].motion.q.back());
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(InteractionConstraintsOf, TheArmHitAndTheReplayAreReportedByTheEarlierOne) {
  add(can_at("vase", -0.3, ObjectKind::immovable));
  const Eigen::Vector2d p = hand_at(-0.05);
  add(fixture_box("wall", {p.x(), p.y(), 0.9}, {0.1, 0.02, 0.1}, Touch::forbidden));
  Verdict verdict = run();
  ASSERT_TRUE(rejects(verdict, ViolationKind::robot_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("vase"));
  problem.scene.objects[id("vase").index()].X_WO = can_at("vase", 0.1).X_WO;  // behind the wall now
  verdict = run();
  ASSERT_TRUE(rejects(verdict, ViolationKind::robot_touch));
  EXPECT_EQ(verdict.findings[0].violation.object, id("wall"));
}

}  // namespace
}  // namespace mamo
