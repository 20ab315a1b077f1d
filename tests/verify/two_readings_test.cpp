// The constraints are read twice, by the planners' evaluation and by verify, and neither knows the other. On the same
// motion from the same start both see the same simulation, so they must agree on what breaks first and when.
#include "support/table_world.hpp"
#include "support/verdicts.hpp"

#include "mamo/physics/evaluation.hpp"

namespace mamo {
namespace {

using namespace fixtures;

/// Cans and boxes at random on the circle that the hand sweeps and beside it, with random constraints.
Problem random_clutter(std::uint64_t seed) {
  RandomStream random(seed, {7});
  Problem problem = table_problem(0.3);
  problem.scene.physics.settle_time = 1.0;
  if (random.uniform() < 0.3) {
    const Eigen::Vector2d p = hand_at(random.uniform(-0.2, 0.3));
    const Touch touch = random.uniform() < 0.5 ? Touch::forbidden : Touch::objects;
    problem.scene.objects.push_back(fixture_box("wall", {p.x() + 0.15, p.y(), 0.79}, {0.2, 0.02, 0.04}, touch));
  }
  std::vector<Eigen::Vector2d> taken = {hand_at(-0.6), hand_at(-0.55), hand_at(-0.5)};
  const int count = 1 + static_cast<int>(random.below(9));
  for (int k = 0; k < count; ++k) {
    const double r = random.uniform(0.025, 0.04);
    const Eigen::Vector2d p = hand_at(random.uniform(-0.45, 0.4)) + Eigen::Vector2d(random.uniform(-0.15, 0.1), 0);
    bool fits = true;
    for (const Eigen::Vector2d& other : taken) fits = fits && (other - p).norm() > 0.095;
    if (!fits) continue;
    taken.push_back(p);
    const ObjectKind kind = random.uniform() < 0.15 ? ObjectKind::immovable : ObjectKind::movable;
    Object o = standing_cylinder("object_" + std::to_string(k), p.x(), p.y(), r, random.uniform(0.08, 0.14), kind,
                                 random.uniform(0.05, 0.5), random.uniform(0.1, 1.0));
    if (random.uniform() < 0.3) o.constraints.max_tilt = 0.4363;
    if (random.uniform() < 0.3) o.constraints.max_speed = random.uniform(0.15, 1.0);
    if (random.uniform() < 0.3) o.constraints.max_displacement = random.uniform(0.05, 0.4);
    if (random.uniform() < 0.3) o.constraints.may_leave_support = false;
    if (random.uniform() < 0.1) o.constraints.touch = Touch::robot;
    problem.scene.objects.push_back(o);
  }
  return problem;
}

TEST(TwoReadingsOfTheConstraints, AgreeOnEveryMotion) {
  std::map<ViolationKind, int> seen;
  int valid = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Problem problem = random_clutter(seed);
    const Plan plan = sweep(problem, {0.3});
    Evaluator evaluator(std::make_shared<const ForwardKinematics>(problem.robot), problem.scene);
    const ObjectSet present = ObjectSet::all(problem.scene);
    const WorldState start = WorldState::start_of(problem.scene);
    EvaluationRequest request;
    request.present = &present;
    request.from = &start;
    request.motion = &plan.segments[0].motion;
    const Evaluation evaluation = evaluator.evaluate(request);
    const Verdict verdict = judge(problem, plan);
    ASSERT_EQ(verdict.ok, evaluation.valid)
        << "seed " << seed << "\n"
        << report(verdict) << (evaluation.violation ? to_string(evaluation.violation->kind) : "none");
    if (verdict.ok) {
      ++valid;
      for (ObjectId id : present.ids())
        EXPECT_LT((verdict.objects_after[0].at(id).translation() - evaluation.state.X_WO(id).translation()).norm(),
                  2e-3)
            << "seed " << seed << " object " << problem.scene[id].id;
      continue;
    }
    const Violation &mine = verdict.findings[0].violation, &theirs = *evaluation.violation;
    ++seen[mine.kind];
    // Two things may break in one step, and the order within it is each one's own.
    EXPECT_NEAR(mine.time_s, theirs.time_s, 1e-6) << "seed " << seed << "\n" << report(verdict);
    if (mine.kind == theirs.kind && mine.object == theirs.object) {
      EXPECT_NEAR(mine.value, theirs.value, 1e-4) << "seed " << seed << "\n" << report(verdict);
    }
  }
  EXPECT_GT(valid, 10);
  EXPECT_GE(seen.size(), 5u);
}

}  // namespace
}  // namespace mamo
