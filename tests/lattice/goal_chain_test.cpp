#include "mamo/lattice/goal_chain.hpp"

#include "support/reach_problem.hpp"

namespace mamo {
namespace {

struct Chains {
  explicit Chains(const Problem& problem, std::uint64_t seed = 1, GoalChainOptions options = {})
      : kinematics(std::make_shared<ForwardKinematics>(problem.robot)), checker(kinematics, problem.scene) {
    const RelevantBodies all = make_relevant_bodies(problem, ObjectSet::all(problem.scene));
    walls = ObjectSet(problem.scene.size());
    for (ObjectId id : all.forbidden.ids())
      if (!problem.scene[id].movable()) walls.insert(id);
    goal = make_reach_goal(problem, *kinematics, tracked_point(*kinematics), checker, walls, seed, 6);
    GoalChains made = make_goal_chains(problem, checker, walls, goal.configurations, seed, options, nullptr);
    chains = std::move(made.chains);
    budget_used_up = made.budget_used_up;
  }
  std::shared_ptr<const ForwardKinematics> kinematics;
  CollisionChecker checker;
  ObjectSet walls;
  ReachGoal goal;
  std::vector<GoalChain> chains;
  bool budget_used_up = false;
};

TEST(GoalChain, LeadsFromTheStartToAGoalAmongWhatStays) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Problem problem = fixtures::reach_problem(6, 3, seed);
    Chains c(problem, seed);
    if (c.goal.configurations.empty()) continue;
    CollisionReport report;
    for (const GoalChain& chain : c.chains) {
      ++found;
      EXPECT_EQ(chain.q.front(), problem.q_start);
      EXPECT_EQ(chain.q.back(), c.goal.configurations[static_cast<std::size_t>(chain.goal)]);
      for (std::size_t k = 1; k < chain.q.size(); ++k) {
        EXPECT_TRUE(c.checker.check_edge(chain.q[k - 1], chain.q[k], c.walls, ObjectSet(), report)) << "seed " << seed;
        EXPECT_LE((chain.q[k] - chain.q[k - 1]).norm(), GoalChainOptions{}.spacing + 1e-9);
      }
    }
  }
  EXPECT_GE(found, 5);
}

TEST(GoalChain, DoesNotSeeMovablesAndRepeatsForTheSameSeed) {
  Problem empty = fixtures::reach_problem(0, 0, 4), full = fixtures::reach_problem(10, 0, 4);
  full.task = empty.task;
  const Chains a(empty), b(full), again(full);
  ASSERT_FALSE(a.chains.empty());
  ASSERT_EQ(a.chains.size(), b.chains.size());
  for (std::size_t k = 0; k < a.chains.size(); ++k) {
    EXPECT_EQ(a.chains[k].q, b.chains[k].q);
    EXPECT_EQ(b.chains[k].q, again.chains[k].q);
  }
}

TEST(GoalChain, IsLeftOutWhenItsBudgetIsUsedUp) {
  GoalChainOptions options;
  options.max_nodes = 2;
  const Chains cut(fixtures::reach_problem(0, 4, 1), 1, options);
  EXPECT_LT(cut.chains.size(), 3u);
  EXPECT_TRUE(cut.budget_used_up);
  options.chains = 0;
  const Chains none(fixtures::reach_problem(0, 0, 1), 1, options);
  EXPECT_TRUE(none.chains.empty());
  EXPECT_FALSE(none.budget_used_up);
  EXPECT_FALSE(Chains(fixtures::reach_problem(0, 0, 4)).budget_used_up);
}

}  // namespace
}  // namespace mamo
