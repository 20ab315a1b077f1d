// What a plan must look like before anything moves, and the arm against itself and the fixtures.
#include <limits>

#include "support/table_world.hpp"
#include "support/verdicts.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class PlanForm : public testing::Test {
 protected:
  Problem problem = table_problem(0.2);
  Plan plan = sweep(problem, {-0.3, 0.0, 0.2});
};

TEST_F(PlanForm, APlanInFreeSpaceHoldsAndTouchesNothing) {
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(holds(verdict));
  EXPECT_TRUE(verdict.interactions.empty());
}

TEST_F(PlanForm, AnEmptyPlanIsMalformed) { EXPECT_TRUE(rejects(judge(problem, {}), ViolationKind::malformed_plan)); }

TEST_F(PlanForm, AnUnknownJointIsNamed) {
  plan.segments[1].joint_names[2] = "elbow_of_another_robot";
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::malformed_plan, 1));
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("elbow_of_another_robot"));
}

TEST_F(PlanForm, AJointNamedTwiceIsMalformed) {
  plan.segments[2].joint_names[1] = plan.segments[2].joint_names[0];
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::malformed_plan, 2));
}

TEST_F(PlanForm, ASegmentWithoutPointsIsMalformed) {
  plan.segments[1].motion = {};
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::malformed_plan, 1));
}

TEST_F(PlanForm, PointsOfTheWrongSizeAreMalformed) {
  plan.segments[1].motion.q.back().conservativeResize(6);
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::malformed_plan, 1));
  plan = sweep(problem, {-0.3, 0.0, 0.2});
  plan.segments[1].motion.t.pop_back();
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::malformed_plan, 1));
}

TEST_F(PlanForm, NumbersThatAreNoneAreMalformed) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Plan changed = plan;
    changed.segments[1].motion.q[1][3] = bad;
    EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
    changed = plan;
    changed.segments[1].motion.t[1] = bad;
    EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
    changed = plan;
    problem.scene.objects.push_back(can_at("can", 0.6));
    changed.segments[2].objects_after[ObjectId{1}] = at(bad, 0, 0);
    EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 2));
  }
}

TEST_F(PlanForm, TimesStartAtZeroAndIncrease) {
  Plan changed = plan;
  changed.segments[1].motion.t[0] = 0.1;
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
  changed = plan;
  changed.segments[1].motion.t[1] = 0;
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
}

TEST_F(PlanForm, ObjectsThatAreNoneAreMalformed) {
  Plan changed = plan;
  changed.segments[1].object = ObjectId{17};
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
  changed = plan;
  changed.segments[1].objects_after[ObjectId{0}] = problem.scene.objects[0].X_WO;  // a fixture
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::malformed_plan, 1));
}

TEST_F(PlanForm, ASegmentMayNameSomeJointsOnlyAndTheOthersKeepTheirValue) {
  for (Segment& segment : plan.segments) {
    segment.joint_names = {"shoulder_pan"};
    for (Eigen::VectorXd& q : segment.motion.q) q = Eigen::VectorXd(q.head(1));
  }
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(PlanForm, TheOrderOfJointNamesIsTheirOwn) {
  for (Segment& segment : plan.segments) {
    std::reverse(segment.joint_names.begin(), segment.joint_names.end());
    for (Eigen::VectorXd& q : segment.motion.q) q = Eigen::VectorXd(q.reverse());
  }
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(PlanForm, APlanThatStartsElsewhereIsRejected) {
  for (Eigen::VectorXd& q : plan.segments[0].motion.q) q[1] += 2e-6;
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::wrong_start));
  EXPECT_NEAR(verdict.findings[0].violation.value, 2e-6, 1e-9);
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("shoulder_lift"));
}

TEST_F(PlanForm, AJumpBetweenSegmentsIsRejected) {
  for (Eigen::VectorXd& q : plan.segments[2].motion.q) q[4] += 0.01;
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::discontinuity, 2));
  EXPECT_NEAR(verdict.findings[0].violation.value, 0.01, 1e-9);
  EXPECT_NEAR(verdict.findings[0].violation.time_s,
              plan.segments[0].motion.duration() + plan.segments[1].motion.duration(), 1e-9);
}

TEST_F(PlanForm, AContinuousJointMustNotJumpByATurn) {
  for (Eigen::VectorXd& q : plan.segments[1].motion.q) q[4] += 2 * std::numbers::pi;
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::discontinuity, 1));
}

TEST_F(PlanForm, AJointBeyondItsLimitIsRejected) {
  plan = sweep(problem, {0.2, 0.72, 0.2});  // the limit is 0.7146
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::joint_limit, 1));
  EXPECT_DOUBLE_EQ(verdict.findings[0].violation.value, 0.72);
  EXPECT_DOUBLE_EQ(verdict.findings[0].violation.limit, 0.7146);
}

TEST_F(PlanForm, AMotionFasterThanTheSpeedScaleAllowsIsRejected) {
  plan.segments[1].motion.t[1] *= 0.95;
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::joint_velocity, 1));
  EXPECT_NEAR(verdict.findings[0].violation.limit, 0.2088, 1e-5);
  EXPECT_GT(verdict.findings[0].violation.value, 0.2088);
}

TEST_F(PlanForm, ASlowerMotionHolds) {
  plan.segments[1].motion.t[1] *= 1.7;  // no whole number of steps any more
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(PlanForm, APlanThatEndsElsewhereDoesNotDoTheTask) {
  const Verdict verdict = judge(problem, sweep(problem, {-0.3, 0.18}));
  EXPECT_TRUE(rejects(verdict, ViolationKind::task_not_done, 1));
  EXPECT_NEAR(verdict.findings[0].violation.value, 0.02, 1e-9);
}

TEST_F(PlanForm, AGoalPoseHasTolerancesForPositionAndAngle) {
  const ForwardKinematics kinematics(problem.robot);
  ReachPose reach;
  reach.X_WT = kinematics.tip_pose(over_table(0.2));
  problem.task = reach;
  EXPECT_TRUE(holds(judge(problem, plan)));
  reach.X_WT.translation().z() += 0.011;
  problem.task = reach;
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::task_not_done, 2));
  reach.X_WT = kinematics.tip_pose(over_table(0.2)) * Eigen::AngleAxisd(0.06, Eigen::Vector3d::UnitX());
  problem.task = reach;
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::task_not_done, 2));
  EXPECT_NEAR(verdict.findings[0].violation.value, 0.06, 1e-6);
}

TEST_F(PlanForm, AContinuousJointMayEndATurnAway) {
  problem.task = ReachJoints{over_table(0.2) + 2 * std::numbers::pi * Eigen::VectorXd::Unit(7, 6), 0.0175};
  EXPECT_TRUE(holds(judge(problem, plan)));
}

// The arm against fixtures: the hand sweeps through a wall that is thinner than one simulation step is long.
TEST_F(PlanForm, AThinWallInTheWayIsHit) {
  const Eigen::Vector2d p = hand_at(-0.1);
  problem.scene.objects.push_back(fixture_box("foil", {p.x(), p.y(), 0.87}, {0.1, 0.0005, 0.2}, Touch::forbidden));
  const Verdict verdict = judge(problem, plan);
  EXPECT_TRUE(rejects(verdict, ViolationKind::robot_touch, 1));
  EXPECT_EQ(verdict.findings[0].violation.object, problem.scene.find("foil"));
  EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("(link "));
  // Not on the way: no violation.
  problem.scene.objects.back().X_WO = at(p.x(), p.y(), 1.2);
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(PlanForm, ASupportIsNotForTheRobot) {
  const Eigen::Vector2d p = hand_at(-0.1);
  problem.scene.objects.push_back(fixture_box("step", {p.x(), p.y(), 0.81}, {0.2, 0.02, 0.08}, Touch::support));
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::robot_touch, 1));
  problem.scene.objects.back().constraints.touch = Touch::allowed;
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(PlanForm, AStaticImmovableIsHitThoughTheSimulatorSeesNothing) {
  Object post = can_at("post", -0.1, ObjectKind::immovable);
  post.mass = 0;
  problem.scene.objects.push_back(post);
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::robot_touch, 1));
}

TEST_F(PlanForm, WhatAStillLinkTouchesIsNoMatter) {
  problem.scene.objects.push_back(fixture_box("plinth", {-0.15, 0, 0.3}, {0.4, 0.5, 0.3}, Touch::forbidden));
  EXPECT_TRUE(holds(judge(problem, plan)));
}

// A plan of one point is judged like a configuration; the collision module, which shares no code with verify, is the
// oracle.
TEST(ArmCheckOnRandomConfigurations, AgreesWithTheCollisionModule) {
  Problem problem;
  problem.robot = pr2_like_arm();
  problem.scene = shelf();
  CollisionChecker checker(std::make_shared<const ForwardKinematics>(problem.robot), problem.scene);
  checker.set_state(WorldState::start_of(problem.scene));
  ObjectSet fixtures(problem.scene.size());
  for (std::size_t i = 0; i < problem.scene.size(); ++i) fixtures.insert(ObjectId(i));
  const std::uint64_t seed = 20;
  RandomStream random(seed, {1});
  int self = 0, touched = 0, free = 0;
  for (int k = 0; k < 400; ++k) {
    Eigen::VectorXd q(7);
    for (int i = 0; i < 7; ++i) {
      const Joint& joint = problem.robot.joint(i);
      const bool turns = joint.type == JointType::continuous;
      q[i] = random.uniform(turns ? -3 : joint.lower, turns ? 3 : joint.upper);
    }
    problem.q_start = q;
    problem.task = ReachJoints{q, 0.0175};
    Plan plan;
    plan.segments.push_back(motion(problem, {q}));
    const Verdict verdict = judge(problem, plan);
    CollisionReport report;
    checker.check(q, fixtures, false, report);
    ASSERT_EQ(verdict.ok, report.free()) << "seed " << seed << " draw " << k;
    if (verdict.ok) {
      ++free;
    } else if (verdict.findings[0].violation.kind == ViolationKind::self_collision) {
      ++self;
      EXPECT_TRUE(report.self);
      EXPECT_THAT(verdict.findings[0].text, testing::HasSubstr("(links "));
    } else {
      ++touched;
      EXPECT_EQ(verdict.findings[0].violation.kind, ViolationKind::robot_touch);
      EXPECT_THAT(report.touched, testing::Contains(verdict.findings[0].violation.object));
    }
  }
  EXPECT_GT(self, 5);
  EXPECT_GT(touched, 20);
  EXPECT_GT(free, 20);
}

}  // namespace
}  // namespace mamo
