// Each kind of violation: a push that commits it, and one that only just does not.
#include <gtest/gtest.h>

#include "support/pusher.hpp"

namespace mamo {
namespace {

using namespace pushing;

constexpr double kLow = kTop + 0.02;
constexpr double kReach = 0.02;    // m: the finger's radius
constexpr double kRadius = 0.035;  // m: a can's

/// Finger along x at height z from x = -0.1 until it is at `end`.
TimedPath push_to(double end, double z = kLow, double speed = 0.1) {
  return along({{-0.1, 0, z}, {end, 0, z}}, 1.0 / 120, speed);
}

void expect_valid(const Evaluation& e) {
  EXPECT_TRUE(e.valid);
  if (e.violation)
    ADD_FAILURE() << to_string(e.violation->kind) << " of " << e.violation->object.value << " by "
                  << e.violation->other.value << " value " << e.violation->value << " at " << e.violation->time_s;
}

void expect_violation(const Evaluation& e, ViolationKind kind, ObjectId object, ObjectId other) {
  EXPECT_FALSE(e.valid);
  ASSERT_TRUE(e.violation.has_value()) << "nothing violated, expected " << to_string(kind);
  EXPECT_EQ(to_string(e.violation->kind), to_string(kind));
  EXPECT_EQ(e.violation->object, object);
  EXPECT_EQ(e.violation->other, other);
  EXPECT_GE(e.violation->value, e.violation->limit);
  EXPECT_GT(e.violation->time_s, 0);
}

//   finger ->  |can|
TEST(Violations, ACanPushedLowSlidesAndPushedHighTips) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, can("a", 0.05, 0, 0.03, 0.2));
  bench.scene.objects[id.index()].constraints.max_tilt = 25 * std::numbers::pi / 180;
  expect_valid(bench.evaluate(push_to(0.15, kTop + 0.02)));
  const Evaluation high = bench.evaluate(push_to(0.15, kTop + 0.18));
  expect_violation(high, ViolationKind::tilt, id, kNoObject);
  EXPECT_LT(high.violation->value, 30 * std::numbers::pi / 180) << "seen only later";
}

TEST(Violations, YawIsNoTilt) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, block("a", 0.05, 0.02, {0.06, 0.1, 0.06}));
  bench.scene.objects[id.index()].constraints.max_tilt = 0.1;
  const Evaluation e = bench.evaluate(push_to(0.15));
  expect_valid(e);
  EXPECT_GT(Eigen::AngleAxisd(e.state.X_WO(id).linear()).angle(), 0.3);
}

TEST(Violations, AnObjectThatStartsLyingTiltsFromThere) {
  Bench bench{table()};
  Object lying = can("a", 0.05, 0, 0.03, 0.2);
  lying.X_WO = fixtures::lying(0.15, 0, kTop + 0.03);
  const ObjectId id = add(bench.scene, lying);
  bench.scene.objects[id.index()].constraints.max_tilt = 0.2;
  expect_valid(bench.evaluate(push_to(0.1)));  // along its axis: it slides
}

TEST(Violations, SpeedIsTheNormOfTheCentreOfMass) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, block("a", 0.05, 0));
  bench.scene.objects[id.index()].constraints.max_speed = 0.6;
  expect_valid(bench.evaluate(push_to(0.3, kLow, 0.4)));
  bench.scene.objects[id.index()].constraints.max_speed = 0.3;
  expect_violation(bench.evaluate(push_to(0.3, kLow, 0.4)), ViolationKind::speed, id, kNoObject);
}

// The table ends at x = 1.
TEST(Violations, AnObjectLeavesItsSupportWhenItsCentreIsBesideIt) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, block("a", 0.9, 0));
  bench.scene.objects[id.index()].constraints.may_leave_support = false;
  const auto push_centre_to = [](double x) { return along({{0.8, 0, kLow}, {x - 0.03 - kReach, 0, kLow}}); };
  expect_valid(bench.evaluate(push_centre_to(0.99)));
  const Evaluation e = bench.evaluate(push_centre_to(1.01));
  expect_violation(e, ViolationKind::left_support, id, kNoObject);
  EXPECT_LT(e.violation->value, 0.002);
  bench.scene.objects[id.index()].constraints.may_leave_support = true;
  const Evaluation falls = bench.evaluate(push_centre_to(1.05));
  expect_valid(falls);
  EXPECT_LT(falls.state.X_WO(id).translation().z(), 0.1) << "the floor catches it";
  EXPECT_GT(falls.settle_s, 0.3);
}

//  [b] on [a] on the table: b slides off a onto the table, which is lower.
TEST(Violations, AnObjectThatSlipsOffWhatItStoodOnHasLeft) {
  Bench bench{table()};
  add(bench.scene, block("a", 0.1, 0, {0.1, 0.1, 0.06}, 2.0, 0.9));
  Object upper = block("b", 0.1, 0, {0.05, 0.05, 0.05}, 0.1, 0.2);
  upper.X_WO.translation().z() = kTop + 0.06 + 0.025;
  upper.constraints.may_leave_support = false;
  const ObjectId b = add(bench.scene, upper);
  const double z = kTop + 0.085;
  expect_valid(bench.evaluate(along({{0, 0, z}, {0.085, 0, z}})));
  expect_violation(bench.evaluate(along({{0, 0, z}, {0.2, 0, z}})), ViolationKind::left_support, b, kNoObject);
}

TEST(Violations, AFallenCanHasNotLeftItsSupport) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, can("a", 0.05, 0, 0.03, 0.2));
  bench.scene.objects[id.index()].constraints.may_leave_support = false;
  const Evaluation e = bench.evaluate(push_to(0.15, kTop + 0.18));
  expect_valid(e);
  EXPECT_LT(e.state.X_WO(id).translation().z(), kTop + 0.04);
}

TEST(Violations, DisplacementCountsFromTheScenesStart) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, block("a", 0.1, 0));
  bench.scene.objects[id.index()].constraints.max_displacement = 0.1;
  const double touch = 0.1 - 0.03 - kReach;
  expect_valid(bench.evaluate(push_to(touch + 0.095)));
  expect_violation(bench.evaluate(push_to(touch + 0.105)), ViolationKind::displacement, id, kNoObject);

  WorldState later = WorldState::start_of(bench.scene);
  later[id] = quantise(at(0.18, 0, kTop + 0.03));
  EvaluationRequest request;
  request.from = &later;
  expect_violation(bench.evaluate(push_to(touch + 0.105), request), ViolationKind::displacement, id, kNoObject);
}

TEST(Violations, AnImmovableMayMoveByLessThanTheTolerance) {
  Bench bench{table()};
  Object heavy = block("a", 0.1, 0);
  heavy.kind = ObjectKind::immovable;
  const ObjectId id = add(bench.scene, heavy);
  const double touch = 0.1 - 0.03 - kReach;
  expect_valid(bench.evaluate(push_to(touch + 0.8 * kImmovableTolerance)));
  expect_violation(bench.evaluate(push_to(touch + 1.2 * kImmovableTolerance)), ViolationKind::immovable_moved, id,
                   kNoObject);
}

TEST(Violations, TheRobotMustNotTouchWhatForbidsIt) {
  for (const Touch touch : {Touch::forbidden, Touch::objects}) {
    Bench bench{table()};
    Object o = block("a", 0.1, 0);
    o.constraints.touch = touch;
    const ObjectId id = add(bench.scene, o);
    const double contact = 0.1 - 0.03 - kReach;
    expect_valid(bench.evaluate(push_to(contact - 0.0005)));
    expect_violation(bench.evaluate(push_to(contact + 0.0015)), ViolationKind::robot_touch, id, kRobot);
  }
}

TEST(Violations, TheTargetMustNotBeTouchedByAnybody) {
  Bench bench{table()};
  const ObjectId pushed = add(bench.scene, block("a", 0.05, 0));
  const ObjectId target = add(bench.scene, block("b", 0.15, 0));
  EvaluationRequest request;
  request.untouchable = target;
  const double contact = 0.05 - 0.03 - kReach;
  expect_valid(bench.evaluate(push_to(contact + 0.0385), request));
  expect_violation(bench.evaluate(push_to(contact + 0.045), request), ViolationKind::object_touch, target, pushed);
  request.untouchable = pushed;
  expect_violation(bench.evaluate(push_to(contact + 0.01), request), ViolationKind::robot_touch, pushed, kRobot);
}

//  finger -> [a]  gap  [b: only the robot may touch]
TEST(Violations, ObjectsMustNotTouchWhatForbidsThem) {
  for (const Touch touch : {Touch::forbidden, Touch::robot}) {
    for (const double mass : {0.0, 3.0}) {
      Bench bench{table()};
      const ObjectId pushed = add(bench.scene, block("a", 0.05, 0));
      Object o = block("b", 0.15, 0);
      o.constraints.touch = touch;
      o.kind = ObjectKind::immovable;
      o.mass = mass;
      const ObjectId id = add(bench.scene, o);
      const double contact = 0.05 - 0.03 - kReach;
      expect_valid(bench.evaluate(push_to(contact + 0.0385)));
      expect_violation(bench.evaluate(push_to(contact + 0.043)), ViolationKind::object_touch, id, pushed);
    }
  }
}

TEST(Violations, OfAMovableAndAForbiddenWallTheMovableIsNamed) {
  Bench bench{table()};
  const ObjectId wall =
      add(bench.scene, fixtures::fixture_box("wall", {0.2, 0, kTop + 0.1}, {0.02, 0.5, 0.2}, Touch::forbidden));
  const ObjectId id = add(bench.scene, block("a", 0.1, 0));
  const double contact = 0.19 - 0.06 - kReach;
  expect_valid(bench.evaluate(push_to(contact - 0.001)));
  expect_violation(bench.evaluate(push_to(contact + 0.003)), ViolationKind::object_touch, id, wall);
}

//  [b: forbidden][a] -> the finger draws a away sideways
TEST(Violations, WhatTouchesAtTheStartMayGoOnTouching) {
  const double gap_allowed = 0, gap_refused = 2 * kTouchDistance;
  for (const double gap : {gap_allowed, gap_refused}) {
    Bench bench{table()};
    Object b = block("b", 0, 0.06 + gap);
    b.kind = ObjectKind::immovable;
    b.constraints.touch = Touch::forbidden;
    const ObjectId forbidden = add(bench.scene, b);
    const ObjectId id = add(bench.scene, block("a", 0, 0));
    // Off the centre, so that the near corner turns towards b.
    const TimedPath motion = along({{-0.1, -0.015, kLow}, {0.0, -0.015, kLow}});
    const Evaluation e = bench.evaluate(motion);
    if (gap == gap_allowed)
      expect_valid(e);
    else
      expect_violation(e, ViolationKind::object_touch, forbidden, id);
  }
}

//  finger -> (can) | wall: the can cannot yield
TEST(Violations, SqueezingIsPenetration) {
  Bench bench{table()};
  add(bench.scene, fixtures::fixture_box("wall", {0.2, 0, kTop + 0.1}, {0.02, 0.5, 0.2}, Touch::objects));
  const ObjectId id = add(bench.scene, block("a", 0.1, 0));
  const double contact = 0.19 - 0.06 - kReach;
  // An arm that yields to nothing may leave what it squeezes a little trembling.
  const Evaluation less = bench.evaluate(push_to(contact + 0.001));
  EXPECT_TRUE(less.valid || less.violation->kind == ViolationKind::not_at_rest);
  const Evaluation e = bench.evaluate(push_to(contact + 0.02));
  ASSERT_TRUE(e.violation);
  EXPECT_EQ(to_string(e.violation->kind), "penetration");
  EXPECT_EQ(e.violation->object, id);
  EXPECT_GT(e.violation->value, kMaxPenetration);
}

TEST(Violations, ABallThatStillRollsAtTheSettleLimitIsNotAtRest) {
  for (const double settle : {0.1, 0.0}) {
    Bench bench{table()};
    bench.scene.physics.settle_time = settle;
    Object ball = can("ball", 0, 0);
    ball.shapes = {{Sphere{kRadius}, at(0, 0, 0)}};
    ball.X_WO = at(0, 0, kTop + kRadius);
    const ObjectId id = add(bench.scene, ball);
    const Evaluation e = bench.evaluate(push_to(0.05));
    expect_violation(e, ViolationKind::not_at_rest, id, kNoObject);
    EXPECT_DOUBLE_EQ(e.settle_s, settle);
  }
  Bench bench{table()};
  bench.scene.physics.settle_time = 0.15;
  add(bench.scene, block("a", 0, 0));
  expect_valid(bench.evaluate(push_to(0.05)));
}

TEST(Violations, OfTwoInOneStepTheFirstByKindThenByIdIsNamed) {
  Bench bench{table()};
  for (const double y : {0.045, -0.045}) {
    Object o = block(y > 0 ? "left" : "right", 0.1, y);
    o.constraints.touch = Touch::forbidden;
    o.constraints.max_displacement = 2e-4;
    add(bench.scene, o);
  }
  bench.kinematics = gantry({{Box{{0.04, 0.2, 0.02}}, at(0, 0, 0)}});
  expect_violation(bench.evaluate(push_to(0.1)), ViolationKind::robot_touch, ObjectId{1}, kRobot);
}

}  // namespace
}  // namespace mamo
