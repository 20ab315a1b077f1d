// Whole retrievals on the shelf built in code, checked by loops that share nothing with the planner but kinematics.
#include <gmock/gmock.h>

#include "support/brute_force.hpp"
#include "support/retrieve_problem.hpp"
#include "support/verdicts.hpp"

namespace mamo {
namespace {

using namespace fixtures;

/// Configurations along the path no further apart than this (rad, norm).
std::vector<Eigen::VectorXd> dense(const std::vector<Eigen::VectorXd>& path) { return subdivided(path, 0.005); }

/// Every pose of a path of the planner against every body that it may not touch there.
void expect_free(const RetrievalSetup& setup, const RetrievalPath& path, const ObjectSet& obstacles) {
  const Problem& problem = setup.problem;
  const ObjectId target = std::get<Retrieve>(problem.task).object;
  BruteForce brute(problem.robot, problem.scene, 0);
  const auto hits = [&](const Eigen::VectorXd& q, bool target_counts, ObjectId support) {
    std::string text;
    for (ObjectId id : brute.touched(q)) {
      if (id == target && !target_counts) continue;
      if (problem.scene[id].movable() && !obstacles.contains(id)) continue;
      if (id != support) text += problem.scene[id].id + " ";
    }
    return text + (brute.self(q) ? "itself" : "");
  };
  for (const Eigen::VectorXd& q : dense(path.approach)) ASSERT_EQ(hits(q, true, kNoObject), "") << "approach";
  for (const Eigen::VectorXd& q : dense(path.reach)) ASSERT_EQ(hits(q, false, kNoObject), "") << "reach";
  brute.held = target;
  brute.held_by = problem.robot.group.tip;
  brute.X_LHeld = setup.kinematics->tip_pose(path.reach.back()).inverse() * problem.scene[target].X_WO;
  bool cleared = false;
  for (const Eigen::VectorXd& q : dense(path.extract)) {
    const double height = (setup.kinematics->tip_pose(q) * brute.X_LHeld).translation().z();
    cleared = cleared || height > problem.scene[target].X_WO.translation().z() + 0.003;
    ASSERT_EQ(hits(q, false, cleared ? kNoObject : problem.scene.find("base")), "") << "extract";
  }
}

void expect_whole(const RetrievalSetup& setup, const RetrievalPath& path) {
  const Retrieve& task = std::get<Retrieve>(setup.problem.task);
  EXPECT_EQ(path.approach.front(), setup.problem.q_start);
  EXPECT_EQ(path.approach.back(), path.reach.front());
  EXPECT_EQ(path.reach.back(), path.extract.front());
  EXPECT_EQ(path.extract.back(), task.home);
  for (const auto* leg : {&path.approach, &path.reach, &path.extract})
    for (const Eigen::VectorXd& q : *leg) EXPECT_TRUE(setup.problem.robot.within_limits(q));
}

class RetrievalOnShelf : public testing::TestWithParam<int> {
 protected:
  RetrievalSetup setup{retrieve_problem(cluttered_shelf(6, 2, static_cast<std::uint64_t>(GetParam())), target_can())};
};

TEST_P(RetrievalOnShelf, WithoutMovablesEveryLegIsFreeAndThePlanSurvivesTheReplay) {
  const RetrievalOutcome outcome = setup.plan(setup.nothing);
  ASSERT_TRUE(outcome.path) << "seed " << GetParam();
  expect_whole(setup, *outcome.path);
  expect_free(setup, *outcome.path, setup.nothing);
  const Problem bare = without_movables(setup.problem);
  EXPECT_TRUE(holds(judge(bare, plan_of(bare, *outcome.path))));
}

TEST_P(RetrievalOnShelf, AmongMovablesWhatIsFoundTouchesNone) {
  const RetrievalOutcome outcome = setup.plan(setup.movables);
  if (!outcome.path) {
    EXPECT_FALSE(outcome.failures.empty());
    return;
  }
  expect_whole(setup, *outcome.path);
  expect_free(setup, *outcome.path, setup.movables);
  EXPECT_TRUE(holds(judge(setup.problem, plan_of(setup.problem, *outcome.path))));
}

TEST_P(RetrievalOnShelf, TheReachMovesTheTipOnALineAndTheLiftGoesStraightUp) {
  ASSERT_FALSE(setup.planner.candidates().empty());
  for (const GraspCandidate& candidate : setup.planner.candidates()) {
    for (const auto* leg : {&candidate.reach, &candidate.lift}) {
      const Eigen::Isometry3d X_WA = setup.kinematics->tip_pose(leg->front());
      const Eigen::Vector3d shift = setup.kinematics->tip_pose(leg->back()).translation() - X_WA.translation();
      double before = -1e-3;
      for (const Eigen::VectorXd& q : dense(*leg)) {
        const Eigen::Isometry3d X = setup.kinematics->tip_pose(q);
        const Eigen::Vector3d p = X.translation() - X_WA.translation();
        const double along = p.dot(shift.normalized());
        ASSERT_LT((p - along * shift.normalized()).norm(), 0.0015);
        ASSERT_GT(along, before - 1e-4) << "never back";
        before = along;
        ASSERT_LT(Eigen::AngleAxisd(X_WA.linear().transpose() * X.linear()).angle(), 0.01);
      }
      EXPECT_LT(leg == &candidate.lift ? shift.head<2>().norm() : std::abs(shift.z()), 0.001);
    }
    EXPECT_EQ(candidate.reach.back(), candidate.lift.front());
  }
}

TEST_P(RetrievalOnShelf, TheHeldObjectStaysUpright) {
  const RetrievalOutcome outcome = setup.plan(setup.nothing);
  ASSERT_TRUE(outcome.path);
  const Eigen::Isometry3d X_WG = setup.kinematics->tip_pose(outcome.path->extract.front());
  const Eigen::Vector3d up_T = X_WG.linear().transpose() * Eigen::Vector3d::UnitZ();
  for (const Eigen::VectorXd& q : dense(outcome.path->extract))
    ASSERT_GT((setup.kinematics->tip_pose(q).linear() * up_T).z(), std::cos(21 * std::numbers::pi / 180));
}

TEST_P(RetrievalOnShelf, TheSameCallGivesTheSamePathWhateverTheWorkerDidBefore) {
  CollisionChecker other(setup.kinematics, setup.problem.scene);
  WorldState elsewhere = setup.state;
  for (ObjectId id : setup.movables.ids()) elsewhere[id].p[0] += 50000;
  const ObjectId target = std::get<Retrieve>(setup.problem.task).object;
  other.set_state(elsewhere);
  other.attach(target, setup.problem.robot.group.tip, Eigen::Isometry3d::Identity());
  const RetrievalPlanner again(setup.problem, setup.kinematics, {}, 1, other);
  other.attach(target, setup.problem.robot.group.tip, Eigen::Isometry3d::Identity());
  for (const ObjectSet& obstacles : {setup.nothing, setup.movables}) {
    const RetrievalOutcome a = setup.plan(obstacles);
    const RetrievalOutcome b = again.plan(other, setup.state, obstacles, 0, nullptr);
    ASSERT_EQ(a.path.has_value(), b.path.has_value());
    EXPECT_EQ(a.failures, b.failures);
    if (!a.path) continue;
    EXPECT_EQ(a.path->grasp, b.path->grasp);
    EXPECT_EQ(a.path->approach, b.path->approach);
    EXPECT_EQ(a.path->extract, b.path->extract);
  }
}

TEST_P(RetrievalOnShelf, TheLeastObstructedCandidatesTouchAsManyObjectsAsIsSaid) {
  using Obstruction = RetrievalPlanner::Obstruction;
  const auto least = [&](int count) {
    return setup.planner.least_obstructed(setup.checker, setup.state, setup.movables, count);
  };
  const std::vector<Obstruction> all = least(1000), few = least(3);
  ASSERT_GE(all.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(few[k].grasp, all[k].grasp);
    EXPECT_EQ(few[k].objects, all[k].objects);
  }
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, [](const Obstruction& o) { return std::pair(o.objects, o.grasp); }));
  const ObjectId target = std::get<Retrieve>(setup.problem.task).object;
  for (const Obstruction& o : {all.front(), all[all.size() / 2], all.back()}) {
    const RetrievalOutcome outcome = setup.plan(setup.nothing, o.grasp);
    ASSERT_TRUE(outcome.path);
    ASSERT_EQ(outcome.path->grasp, o.grasp);
    std::set<ObjectId> sure, perhaps;
    for (auto& [padding, touched] : {std::pair(0.0, &sure), std::pair(0.006, &perhaps)}) {
      BruteForce brute(setup.problem.robot, setup.problem.scene, padding);
      for (const auto* leg : {&outcome.path->approach, &outcome.path->reach, &outcome.path->extract}) {
        if (leg == &outcome.path->extract) {
          brute.held = target;
          brute.held_by = setup.problem.robot.group.tip;
          brute.X_LHeld = setup.grasp_of(*outcome.path).X_TO;
        }
        for (const Eigen::VectorXd& q : subdivided(*leg, 0.02))
          for (ObjectId id : brute.touched(q))
            if (setup.problem.scene[id].movable()) touched->insert(id);
      }
    }
    EXPECT_LE(sure.size(), static_cast<std::size_t>(o.objects));
    EXPECT_GE(perhaps.size(), static_cast<std::size_t>(o.objects));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RetrievalOnShelf, testing::Range(1, 7));

TEST(Retrieval, AWalledInTargetIsGivenUpAtOnceAndTheWallIsNamed) {
  const Object target = target_can();
  RetrievalSetup setup(retrieve_problem(walled_in(target), target));
  ASSERT_TRUE(setup.plan(setup.nothing).path);
  const std::int64_t before = setup.checker.checks();
  const RetrievalOutcome outcome = setup.plan(setup.movables);
  EXPECT_FALSE(outcome.path);
  EXPECT_TRUE(outcome.exhausted);
  ASSERT_FALSE(outcome.failures.empty());
  std::int64_t counted = 0;
  for (const auto& [cause, count] : outcome.failures) {
    EXPECT_THAT(cause, testing::HasSubstr("_in_collision: wall_"));
    counted += count;
  }
  EXPECT_EQ(counted, static_cast<std::int64_t>(setup.planner.candidates().size()));
  // Cheap: a few poses of the arm for each candidate and no search.
  EXPECT_LT(setup.checker.checks() - before, 20 * counted);
}

TEST(Retrieval, TheSearchGoesRoundWhatStandsInTheKnownWay) {
  const Object target = target_can();
  RetrievalOptions options;
  options.grasps = 1;
  options.solutions = 1;
  const auto problem_with = [&](const Scene& scene) {
    Problem problem = retrieve_problem(scene, target);
    problem.q_start[0] -= 0.5;  // home is further round, so that there is a way to block
    std::get<Retrieve>(problem.task).home = problem.robot.posture = problem.q_start;
    return problem;
  };
  RetrievalSetup alone(problem_with(shelf()), options);
  const RetrievalOutcome known = alone.plan(alone.nothing);
  ASSERT_TRUE(known.path);
  // A thin post that the tip goes through outside the shelf, clear of home and of the pre-grasp.
  int posts = 0;
  for (const Eigen::VectorXd& q : subdivided(known.path->extract, 0.3)) {
    const Eigen::Vector3d p = alone.kinematics->tip_pose(q).translation();
    Scene scene = shelf();
    scene.objects.push_back(standing_cylinder("post", p.x(), p.y(), 0.01, 0.04, ObjectKind::movable, 0.1, 0.5, p.z()));
    RetrievalSetup setup(problem_with(scene), options);
    const GraspCandidate& grasp = setup.planner.candidates().front();
    BruteForce brute(setup.problem.robot, setup.problem.scene, 0.01);
    const ObjectId post = setup.problem.scene.find("post");
    const auto hits = [&](const Eigen::VectorXd& at_q) {
      return testing::Matches(testing::Contains(post))(brute.touched(at_q));
    };
    if (p.x() > 0.46 || hits(grasp.reach.front()) || hits(setup.problem.q_start)) continue;
    brute.held = std::get<Retrieve>(setup.problem.task).object;
    brute.held_by = setup.problem.robot.group.tip;
    brute.X_LHeld = grasp.X_TO;
    if (hits(setup.problem.q_start) || hits(grasp.lift.back())) continue;
    const RetrievalOutcome outcome = setup.plan(setup.movables);
    ASSERT_TRUE(outcome.path) << testing::PrintToString(outcome.failures) << " post at " << p.transpose();
    EXPECT_NE(outcome.path->extract, known.path->extract);
    expect_whole(setup, *outcome.path);
    expect_free(setup, *outcome.path, setup.movables);
    ++posts;
  }
  EXPECT_GT(posts, 0);
}

TEST(Retrieval, ATallObjectIsLiftedAsFarAsTheShelfAllows) {
  Object tall = target_can();
  tall.shapes = {{Cylinder{0.04, 0.31}, Eigen::Isometry3d::Identity()}};  // 1 cm below the top
  tall.X_WO.translation().z() = 0.77 + 0.155;
  RetrievalSetup setup(retrieve_problem(shelf(), tall));
  const RetrievalOutcome outcome = setup.plan(setup.nothing);
  ASSERT_TRUE(outcome.path) << testing::PrintToString(setup.planner.rejected());
  expect_free(setup, *outcome.path, setup.nothing);
  EXPECT_TRUE(holds(judge(setup.problem, plan_of(setup.problem, *outcome.path))));
}

TEST(Retrieval, HomeMayBeElsewhereThanTheStart) {
  Problem problem = retrieve_problem(shelf(), target_can());
  problem.q_start[0] += 0.3;
  problem.q_start[3] -= 0.2;
  problem.robot.posture = problem.q_start;
  RetrievalSetup setup(problem);
  const RetrievalOutcome outcome = setup.plan(setup.nothing);
  ASSERT_TRUE(outcome.path);
  expect_whole(setup, *outcome.path);
  expect_free(setup, *outcome.path, setup.nothing);
  EXPECT_TRUE(holds(judge(setup.problem, plan_of(setup.problem, *outcome.path))));
}

TEST(Retrieval, FirstSkipsCandidatesAndAStopEndsTheCall) {
  RetrievalSetup setup(retrieve_problem(shelf(), target_can()));
  const int count = static_cast<int>(setup.planner.candidates().size());
  ASSERT_GT(count, 5);
  const RetrievalOutcome later = setup.plan(setup.nothing, 5);
  ASSERT_TRUE(later.path);
  EXPECT_GE(later.path->grasp, 5);
  EXPECT_FALSE(setup.plan(setup.nothing, count).path);
  StopSource stop;
  stop.request(StopReason::interrupted);
  const RetrievalOutcome stopped = setup.planner.plan(setup.checker, setup.state, setup.nothing, 0, &stop);
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.path);
  EXPECT_FALSE(stopped.exhausted);
}

TEST(Retrieval, AnotherTaskIsRefused) {
  Problem problem = retrieve_problem(shelf(), target_can());
  problem.task = ReachJoints{problem.q_start, 0.0175};
  EXPECT_THROW(RetrievalSetup{problem}, std::invalid_argument);
}

}  // namespace
}  // namespace mamo
