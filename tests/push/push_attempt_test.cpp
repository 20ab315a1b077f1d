// What an attempt returns: a motion from rest to rest that does what it says, or why not.
#include <gtest/gtest.h>

#include <algorithm>

#include "push/push_bodies.hpp"
#include "support/push_problem.hpp"

#include "mamo/model/motion.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class PushAttemptTest : public testing::Test {
 protected:
  explicit PushAttemptTest(Problem p = one_cylinder_problem())
      : problem(std::move(p)), kinematics(std::make_shared<ForwardKinematics>(problem.robot)) {}

  PushOutcome attempt(const PushRequest& request, const PushOptions& options = {}) {
    return PushPlanner(problem, kinematics, options, 1).attempt(request, nullptr, nullptr);
  }
  /// The first valid outcome of a few attempts.
  PushOutcome valid(PushRequest request, const PushOptions& options = {}) {
    PushPlanner planner(problem, kinematics, options, 1);
    PushOutcome out;
    for (request.attempt = 0; request.attempt < 10 && !out.valid(); ++request.attempt)
      out = planner.attempt(request, nullptr, nullptr);
    EXPECT_TRUE(out.valid()) << to_string(out.failure);
    return out;
  }

  Problem problem;
  std::shared_ptr<const ForwardKinematics> kinematics;
};

TEST_F(PushAttemptTest, PushesAFreeObjectWhereItShouldGo) {
  const ObjectId can = problem.scene.find("can");
  for (const double heading : {0.0, 0.6, 1.4, -1.4}) {
    const PushRequest request = straight_push(problem, can, heading, 0.1);
    const PushOutcome out = valid(request);
    ASSERT_TRUE(out.valid()) << heading;
    const Eigen::Vector2d p = out.after.X_WO(can).translation().head<2>();
    EXPECT_LT((p - request.path.back()).norm(), 0.05) << "heading " << heading;
    EXPECT_EQ(out.moved, std::vector<ObjectId>{can});
  }
}

TEST_F(PushAttemptTest, BeginsAndEndsAtRestWithoutAGap) {
  const PushOutcome out = valid(straight_push(problem, problem.scene.find("can"), 0, 0.1));
  EXPECT_EQ(out.approach.front(), problem.q_start);
  EXPECT_EQ(out.approach.back(), out.push.front());
  EXPECT_EQ(out.push.back(), out.retreat.front());
  EXPECT_EQ(out.retreat.back(), problem.q_start);
  for (const auto* path : {&out.approach, &out.push, &out.retreat})
    for (const Eigen::VectorXd& q : *path) EXPECT_TRUE(problem.robot.within_limits(q));
}

TEST_F(PushAttemptTest, ApproachAndRetreatTouchNothing) {
  const PushOutcome out = valid(straight_push(problem, problem.scene.find("can"), 0, 0.1));
  CollisionChecker checker(kinematics, problem.scene);
  const push::PushBodies bodies = push::push_bodies(problem);
  CollisionReport report;
  const auto touches = [&](const std::vector<Eigen::VectorXd>& path) {
    for (std::size_t k = 1; k < path.size(); ++k)
      if (!checker.check_edge(path[k - 1], path[k], bodies.forbidden, bodies.movable, report) ||
          !report.touched.empty())
        return true;
    return false;
  };
  EXPECT_FALSE(touches(out.approach));
  EXPECT_TRUE(touches(out.push));
  checker.set_state(out.after);
  EXPECT_FALSE(touches(out.retreat));
}

TEST_F(PushAttemptTest, PredictsWhatASimulationOfThePushGives) {
  const PushRequest request = straight_push(problem, problem.scene.find("can"), 0.5, 0.15);
  const PushOutcome out = valid(request);
  const TimedPath motion = time_path(problem.robot, out.push, problem.scene.physics.step);
  const ObjectSet all = ObjectSet::all(problem.scene);
  Evaluator evaluator(kinematics, problem.scene);
  EvaluationRequest again;
  again.present = &all;
  again.from = &request.state;
  again.motion = &motion;
  const Evaluation evaluation = evaluator.evaluate(again);
  EXPECT_TRUE(evaluation.valid);
  EXPECT_EQ(evaluation.state, out.after);
  EXPECT_EQ(evaluation.settle_s, out.settle_s);
}

TEST_F(PushAttemptTest, AWayRoundACornerFollowsItsPoints) {
  const ObjectId can = problem.scene.find("can");
  PushRequest request = straight_push(problem, can, 0, 0.1);
  request.path.push_back(request.path.back() + Eigen::Vector2d(0.05, -0.08));
  const PushOutcome out = valid(request);
  EXPECT_LT((out.after.X_WO(can).translation().head<2>() - request.path.back()).norm(), 0.07);
}

TEST_F(PushAttemptTest, SaysThatAStartOutOfReachIsUnreachable) {
  problem.scene.objects[problem.scene.find("can").index()].X_WO = at(3, 0, 0.845);
  EXPECT_EQ(attempt(straight_push(problem, problem.scene.find("can"), 0, 0.1)).failure, PushFailure::start_unreachable);
}

TEST_F(PushAttemptTest, SaysThatAStartInsideSomethingIsInAnObstacle) {
  const double x = 0.65, y = -0.4;
  for (int k = 0; k < 12; ++k) {  // a fence in two rows
    const double angle = k * std::numbers::pi / 6;
    for (const double r : {0.09, 0.15, 0.21, 0.27, 0.33})
      problem.scene.objects.push_back(fixture_box("fence", {x + r * std::cos(angle), y + r * std::sin(angle), 0.9},
                                                  {0.09, 0.18, 0.26}, Touch::forbidden));
  }
  const PushOutcome out = attempt(straight_push(problem, problem.scene.find("can"), 0, 0.1));
  EXPECT_TRUE(out.failure == PushFailure::start_in_collision || out.failure == PushFailure::start_in_obstacle ||
              out.failure == PushFailure::start_unreachable)
      << to_string(out.failure);
}

TEST_F(PushAttemptTest, NeverTouchesTheObjectOfTheTask) {
  // The only way to push the can on is against the target.
  const ObjectId target = problem.scene.find("target"), can = problem.scene.find("can");
  problem.scene.objects[target.index()].X_WO = at(0.735, -0.4, 0.845);
  PushOptions whole;
  whole.least_share = 2;
  for (int k = 0; k < 6; ++k) {
    const PushOutcome out = attempt(straight_push(problem, can, 0, 0.1, k), whole);
    EXPECT_FALSE(out.valid()) << "attempt " << k;
  }
}

TEST_F(PushAttemptTest, StopsBeforeAViolationWhenItMay) {
  const ObjectId target = problem.scene.find("target"), can = problem.scene.find("can");
  problem.scene.objects[target.index()].X_WO = at(0.835, -0.4, 0.845);
  const PushOutcome out = valid(straight_push(problem, can, 0, 0.15));
  EXPECT_LT(out.share, 1);
  EXPECT_GE(out.share, PushOptions{}.least_share);
  EXPECT_EQ(std::count(out.moved.begin(), out.moved.end(), target), 0);
}

TEST_F(PushAttemptTest, APathThatGoesNowhereIsNoPush) {
  PushRequest request = straight_push(problem, problem.scene.find("can"), 0, 0);
  EXPECT_EQ(attempt(request).failure, PushFailure::misses_object);
}

TEST_F(PushAttemptTest, EndsWhenCancelledOrStopped) {
  PushPlanner planner(problem, kinematics, {}, 1);
  const PushRequest request = straight_push(problem, problem.scene.find("can"), 0, 0.1);
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(planner.attempt(request, nullptr, &cancel).failure, PushFailure::stopped);
  StopSource stop;
  stop.request(StopReason::interrupted);
  EXPECT_EQ(planner.attempt(request, &stop, nullptr).failure, PushFailure::stopped);
}

TEST_F(PushAttemptTest, AStoredPushIsReusableUnlessSomethingStandsInItsWay) {
  const ObjectId can = problem.scene.find("can"), other = problem.scene.find("other");
  ASSERT_FALSE(other.valid());
  problem.scene.objects.push_back(standing_cylinder("other", 0.9, -0.8, 0.03, 0.15));
  const ObjectId placed = problem.scene.find("other");
  PushPlanner planner(problem, kinematics, {}, 1);
  PushRequest request = straight_push(problem, can, 0, 0.12);
  PushOutcome out;
  for (; request.attempt < 10 && !out.valid(); ++request.attempt) out = planner.attempt(request, nullptr, nullptr);
  ASSERT_TRUE(out.valid());
  ObjectSet others(problem.scene.size());
  others.insert(placed);
  WorldState state = request.state;
  EXPECT_TRUE(planner.reusable(out, state, others)) << "far away";
  const Eigen::Vector3d end = out.after.X_WO(can).translation();
  state[placed] = quantise(at(end.x() + 0.04, end.y(), 0.845));
  EXPECT_FALSE(planner.reusable(out, state, others)) << "where the can ends up";
  state[placed] = quantise(at(0.5, -0.42, 0.845));
  EXPECT_FALSE(planner.reusable(out, state, others)) << "where the arm goes";
}

}  // namespace
}  // namespace mamo
