// What the memo answers is, bit for bit, what a simulation gives; and it charges in the order of one thread.
#include "mamo/lattice/outcome_memo.hpp"

#include "support/reach_problem.hpp"

namespace mamo {
namespace {

/// Motions of the arm in and out of the shelf, many of which push something.
Eigen::VectorXd near_goal(const Problem& problem, const LatticeModel& model, RandomStream& random) {
  const auto& goals = model.goal().configurations;
  Eigen::VectorXd q = goals[random.below(goals.size())];
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += random.uniform(-0.3, 0.3);
  return problem.robot.within_limits(q) ? q : goals.front();
}

TEST(OutcomeMemo, AnswersLikeTheSimulationForOtherSetsOfObjects) {
  int answered = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Problem problem = fixtures::reach_problem(8, 2, seed);
    fixtures::LatticeKit kit(problem);
    if (kit.model->goal().configurations.empty()) continue;
    EdgeEvaluator fresh(problem, kit.kinematics, {});
    const std::shared_ptr<OutcomeMemo> memo = kit.evaluator.make_memo();
    kit.evaluator.use_memo(memo);
    RandomStream random(seed, {0x6d656d6f});
    for (int k = 0; k < 60; ++k) {
      const Eigen::VectorXd q0 = near_goal(problem, *kit.model, random), q1 = near_goal(problem, *kit.model, random);
      const WorldState start = WorldState::start_of(problem.scene);
      if (!kit.evaluator.evaluate(q0, q1, kit.all, start, nullptr, nullptr).simulated) continue;
      for (int subset = 0; subset < 4; ++subset) {
        ObjectSet some = ObjectSet::of_kind(problem.scene, ObjectKind::immovable);
        for (ObjectId id : kit.all.relevant.ids())
          if (random.below(4) > 0) some.insert(id);
        const RelevantBodies bodies = make_relevant_bodies(problem, some);
        const bool known = memo->find(q0, q1, some, start) != nullptr;
        const std::int64_t before = kit.evaluator.simulations();
        const EdgeResult remembered = kit.evaluator.evaluate(q0, q1, bodies, start, nullptr, nullptr);
        if (!remembered.simulated) continue;
        ++asked;
        answered += known;
        EXPECT_EQ(kit.evaluator.simulations() - before, known ? 0 : 1);
        const EdgeResult simulated = fresh.evaluate(q0, q1, bodies, start, nullptr, nullptr);
        ASSERT_EQ(remembered.valid, simulated.valid);
        EXPECT_EQ(remembered.state, simulated.state);
        EXPECT_EQ(remembered.settle_s, simulated.settle_s);
        EXPECT_EQ(remembered.interactions, simulated.interactions);
        EXPECT_EQ(remembered.second_order, simulated.second_order);
        ASSERT_EQ(remembered.violation.has_value(), simulated.violation.has_value());
        if (!simulated.violation) continue;
        EXPECT_EQ(remembered.violation->kind, simulated.violation->kind);
        EXPECT_EQ(remembered.violation->object, simulated.violation->object);
        EXPECT_EQ(remembered.violation->value, simulated.violation->value);
        EXPECT_EQ(remembered.violation->time_s, simulated.violation->time_s);
      }
    }
  }
  EXPECT_GE(answered, 20) << "of " << asked;
  EXPECT_GT(asked, answered) << "subsets without what took part must be simulated";
}

TEST(OutcomeMemo, ChargesTheFirstUseOnly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Problem problem = fixtures::reach_problem(8, 0, seed);
    fixtures::LatticeKit kit(problem);
    if (kit.model->goal().configurations.empty()) continue;
    kit.evaluator.use_memo(kit.evaluator.make_memo());
    RandomStream random(seed, {0x6d656d6f});
    const WorldState start = WorldState::start_of(problem.scene);
    const Eigen::VectorXd q0 = near_goal(problem, *kit.model, random), q1 = near_goal(problem, *kit.model, random);
    const EdgeResult result = kit.evaluator.evaluate(q0, q1, kit.all, start, nullptr, nullptr);
    if (!result.simulated) continue;
    EXPECT_TRUE(kit.evaluator.counts(result, kit.all, start));
    EXPECT_FALSE(kit.evaluator.counts(result, kit.all, start));
    return;
  }
  FAIL() << "no motion that touches anything";
}

}  // namespace
}  // namespace mamo
