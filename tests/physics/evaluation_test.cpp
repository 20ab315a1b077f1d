#include "mamo/physics/evaluation.hpp"

#include <gmock/gmock.h>

#include "support/shelf_pushes.hpp"

namespace mamo {
namespace {

using namespace pushing;
using testing::ElementsAre;

constexpr double kLow = kTop + 0.02;  // here a can slides rather than tips

std::vector<std::pair<int, int>> pairs_of(const Evaluation& e) {
  std::vector<std::pair<int, int>> out;
  for (const Interaction& i : e.interactions) out.emplace_back(i.a.value, i.b.value);
  return out;
}

//      finger -> (can)
TEST(Evaluation, APushMovesTheObjectInFrontOfTheFinger) {
  Bench bench{table()};
  const ObjectId a = add(bench.scene, can("a", 0.1, 0));
  const ObjectId b = add(bench.scene, can("b", 0.1, 0.2));
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.2, 0, kLow}}));
  ASSERT_TRUE(e.valid);
  const Eigen::Vector3d p = e.state.X_WO(a).translation();
  EXPECT_NEAR(p.x(), 0.2 + 0.02 + 0.035, 0.003);
  EXPECT_NEAR(p.z(), kTop + 0.05, 0.001);
  EXPECT_EQ(e.state[b], WorldState::start_of(bench.scene)[b]) << "nothing touched it";
  EXPECT_THAT(pairs_of(e), ElementsAre(std::pair(kRobot.value, a.value)));
  EXPECT_FALSE(e.second_order);
  EXPECT_EQ(e.steps, 240 + static_cast<int>(std::lround(e.settle_s * 120)));
}

TEST(Evaluation, AMotionThatTouchesNothingChangesNothing) {
  Bench bench{table()};
  add(bench.scene, can("a", 0.1, 0));
  const Evaluation e = bench.evaluate(along({{0, 0.1, kLow}, {0.2, 0.1, kLow}}));
  EXPECT_TRUE(e.valid);
  EXPECT_EQ(e.state, WorldState::start_of(bench.scene));
  EXPECT_TRUE(e.interactions.empty());
  EXPECT_EQ(e.settle_s, 0);
}

//      finger -> [1] [3] [2]
TEST(Evaluation, AChainOfPushesIsReportedInOrderOfFirstContact) {
  Bench bench{table()};
  add(bench.scene, block("near", 0.1, 0));
  add(bench.scene, block("far", 0.28, 0));
  add(bench.scene, block("middle", 0.18, 0));
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.2, 0, kLow}}));
  ASSERT_TRUE(e.valid);
  EXPECT_THAT(pairs_of(e), ElementsAre(std::pair(kRobot.value, 1), std::pair(1, 3), std::pair(2, 3)));
  EXPECT_TRUE(e.second_order);
  EXPECT_LT(e.interactions[0].first_time_s, e.interactions[1].first_time_s);
  EXPECT_LT(e.interactions[1].first_time_s, e.interactions[2].first_time_s);
  EXPECT_NEAR(e.interactions[0].first_time_s, 0.5, 0.05);
}

//      finger -> [1]        [3] on [2], at rest
TEST(Evaluation, RestingContactIsNoInteraction) {
  Bench bench{table()};
  add(bench.scene, block("pushed", 0.1, 0));
  const ObjectId lower = add(bench.scene, block("lower", 0.24, 0, {0.08, 0.08, 0.04}));
  Object top = block("upper", 0.24, 0, {0.05, 0.05, 0.05});
  top.X_WO.translation().z() = kTop + 0.04 + 0.025;
  const ObjectId upper = add(bench.scene, top);
  const Evaluation apart = bench.evaluate(along({{0, 0, kLow}, {0.1, 0, kLow}}));
  EXPECT_THAT(pairs_of(apart), ElementsAre(std::pair(kRobot.value, 1)));
  const Evaluation pushed = bench.evaluate(along({{0, 0, kLow}, {0.17, 0, kLow}}));
  ASSERT_TRUE(pushed.valid);
  EXPECT_THAT(pairs_of(pushed), testing::Contains(std::pair(lower.value, upper.value)));
  EXPECT_NEAR(pushed.state.X_WO(upper).translation().x(), pushed.state.X_WO(lower).translation().x(), 0.01)
      << "carried along";
}

TEST(Evaluation, ObjectsThatAreNotPresentAreNotThere) {
  Bench bench{table()};
  const ObjectId a = add(bench.scene, block("a", 0.1, 0));
  const ObjectId b = add(bench.scene, block("b", 0.18, 0));
  ObjectSet only_a(bench.scene.size());
  only_a.insert(a);
  EvaluationRequest request;
  request.present = &only_a;
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.2, 0, kLow}}), request);
  ASSERT_TRUE(e.valid);
  EXPECT_THAT(pairs_of(e), ElementsAre(std::pair(kRobot.value, a.value)));
  EXPECT_EQ(e.state[b], WorldState::start_of(bench.scene)[b]);
  EXPECT_NEAR(e.state.X_WO(a).translation().x(), 0.25, 0.003);
}

TEST(Evaluation, StopsAtTheFirstViolation) {
  Bench bench{table()};
  Object o = block("a", 0.1, 0);
  o.constraints.touch = Touch::forbidden;
  add(bench.scene, o);
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.5, 0, kLow}}));
  ASSERT_TRUE(e.violation);
  EXPECT_NEAR(e.violation->time_s, 0.5, 0.05);
  EXPECT_DOUBLE_EQ(e.violation->time_s, e.steps / 120.0);
  EXPECT_LT(e.steps, 70);
}

TEST(Evaluation, CancelAndStopEndItAtOnce) {
  Bench bench{table()};
  add(bench.scene, block("a", 0.1, 0));
  const TimedPath motion = along({{0, 0, kLow}, {0.5, 0, kLow}});
  const std::atomic<bool> cancel{true};
  EvaluationRequest request;
  request.cancel = &cancel;
  Evaluation e = bench.evaluate(motion, request);
  EXPECT_TRUE(e.cancelled);
  EXPECT_FALSE(e.valid);
  EXPECT_LE(e.steps, 8);

  StopSource stop;
  stop.request(StopReason::interrupted);
  request = {};
  request.stop = &stop;
  e = bench.evaluate(motion, request);
  EXPECT_TRUE(e.cancelled);
  EXPECT_LE(e.steps, 8);
}

//   finger -> high at a tall can: it falls over when the arm has stopped already
TEST(Evaluation, SettlesUntilAllRestAndJudgesTheSettling) {
  Bench bench{table()};
  const ObjectId id = add(bench.scene, can("a", 0.055, 0, 0.03, 0.2));
  const TimedPath motion = along({{0, 0, kTop + 0.18}, {0.068, 0, kTop + 0.18}});
  const Evaluation e = bench.evaluate(motion);
  ASSERT_TRUE(e.valid);
  EXPECT_GT(e.settle_s, 0.3);
  EXPECT_DOUBLE_EQ(e.settle_s, (e.steps - std::lround(motion.duration() * 120)) / 120.0);
  EXPECT_NEAR(e.state.X_WO(id).translation().z(), kTop + 0.03, 0.002) << "it lies";

  bench.scene.objects[id.index()].constraints.max_tilt = 1.0;
  const Evaluation judged = bench.evaluate(motion);
  ASSERT_TRUE(judged.violation);
  EXPECT_EQ(judged.violation->kind, ViolationKind::tilt);
  EXPECT_GT(judged.violation->time_s, motion.duration());
}

TEST(Evaluation, AnEvaluationDoesNotDependOnThoseBefore) {
  const Scene scene = permissive_shelf(12, 4, 5);
  const std::vector<Push> pushes = random_pushes(scene, 12, 77);
  const auto run = [&](Evaluator& evaluator, const Push& push) {
    EvaluationRequest request;
    request.present = &push.present;
    request.from = &push.from;
    request.motion = &push.motion;
    return evaluator.evaluate(request);
  };
  Evaluator used(gripper_gantry(), scene);
  for (int round = 0; round < 2; ++round)
    for (const Push& push : pushes) {
      Evaluator fresh(gripper_gantry(), scene);
      const Evaluation a = run(used, push), b = run(fresh, push);
      EXPECT_EQ(a.state, b.state);
      EXPECT_EQ(a.interactions, b.interactions);
      EXPECT_EQ(a.steps, b.steps);
      EXPECT_EQ(a.violation ? a.violation->value : -1, b.violation ? b.violation->value : -1);
    }
  EXPECT_EQ(used.simulations(), 24);
  EXPECT_GT(used.simulation_s(), 0);
}

//  the finger holds [a], which stands on [b: forbidden]; [c: forbidden] is in the way
TEST(Evaluation, AHeldObjectIsRobotAndMayTouchItsSupportUntilItClearsIt) {
  Bench bench{table()};
  Object base = block("b", 0, 0, {0.1, 0.1, 0.04}, 1.0);
  base.kind = ObjectKind::immovable;
  base.constraints.touch = Touch::forbidden;
  const ObjectId b = add(bench.scene, base);
  Object held = block("a", 0, 0, {0.05, 0.05, 0.05});
  held.X_WO.translation().z() = kTop + 0.04 + 0.025;
  const ObjectId a = add(bench.scene, held);
  Object other = block("c", 0.3, 0, {0.05, 0.05, 0.2});
  other.constraints.touch = Touch::forbidden;
  const ObjectId c = add(bench.scene, other);

  EvaluationRequest request;
  request.held = a;
  request.held_link = LinkId{3};
  const double z = kTop + 0.12;
  const Evaluation lift = bench.evaluate(along({{0, 0, z}, {0, 0, z + 0.06}, {0.1, 0, z + 0.06}}), request);
  EXPECT_TRUE(lift.valid);
  EXPECT_NEAR((lift.state.X_WO(a).translation() - Eigen::Vector3d(0.1, 0, kTop + 0.125)).norm(), 0, 1e-5);
  EXPECT_EQ(lift.state[b], WorldState::start_of(bench.scene)[b]);

  const Evaluation hit = bench.evaluate(along({{0, 0, z}, {0, 0, z + 0.06}, {0.3, 0, z + 0.06}}), request);
  ASSERT_TRUE(hit.violation);
  EXPECT_EQ(hit.violation->kind, ViolationKind::robot_touch);
  EXPECT_EQ(hit.violation->object, c);
  EXPECT_EQ(hit.violation->other, kRobot);

  const Evaluation back = bench.evaluate(along({{0, 0, z}, {0, 0, z + 0.03}, {0, 0, z - 0.005}}), request);
  ASSERT_TRUE(back.violation) << "it had cleared its support";
  EXPECT_EQ(back.violation->object, b);
}

TEST(Evaluation, TheArmPassesThroughWhatItGrasps) {
  Bench bench{table()};
  const ObjectId a = add(bench.scene, block("a", 0.1, 0));
  EvaluationRequest request;
  request.grasped = a;
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.2, 0, kLow}}), request);
  EXPECT_TRUE(e.valid);
  EXPECT_EQ(e.state[a], WorldState::start_of(bench.scene)[a]);
}

TEST(Evaluation, MisuseThrows) {
  Bench bench{table()};
  const ObjectId a = add(bench.scene, block("a", 0.1, 0));
  const TimedPath motion = along({{0, 0, kLow}, {0.2, 0, kLow}});
  Evaluator evaluator(bench.kinematics, bench.scene);
  EXPECT_THROW((void)evaluator.evaluate({}), std::invalid_argument);
  const ObjectSet none(bench.scene.size());
  EvaluationRequest request;
  request.present = &none;
  request.held = a;
  request.held_link = LinkId{3};
  EXPECT_THROW((void)bench.evaluate(motion, request), std::invalid_argument);
}

}  // namespace
}  // namespace mamo
