#include "mamo/lattice/manipulation_lattice.hpp"

#include "support/reach_problem.hpp"

namespace mamo {
namespace {

using fixtures::LatticeKit;

LatticeState random_walk(const LatticeModel& model, int dof, RandomStream& random, int steps) {
  LatticeState s;
  s.bins.assign(static_cast<std::size_t>(dof), 0);
  std::vector<LatticeModel::Move> moves;
  for (int k = 0; k < steps; ++k) {
    model.moves(s, moves);
    const auto& m = moves[random.below(moves.size())];
    if (m.anchor != s.anchor) continue;  // stay on the start's lattice
    s.bins = m.bins;
  }
  return s;
}

TEST(ManipulationLattice, HeuristicIsConsistentOnValidEdges) {
  int edges = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Problem problem = fixtures::reach_problem(0, 4, seed);
    LatticeKit kit(problem);
    RandomStream random(seed, {7});
    std::vector<LatticeModel::Move> moves;
    for (int walk = 0; walk < 60; ++walk) {
      const LatticeState s = random_walk(*kit.model, problem.robot.dof(), random, static_cast<int>(random.below(40)));
      const Eigen::VectorXd q = kit.model->configuration(s.anchor, s.bins);
      kit.model->moves(s, moves);
      for (const auto& m : moves) {
        const Eigen::VectorXd next = kit.model->configuration(m.anchor, m.bins);
        if (!kit.evaluator.evaluate(q, next, kit.all, WorldState::start_of(problem.scene), nullptr, nullptr).valid)
          continue;
        ++edges;
        const search::Cost h_next = reaches(kit.model->goal(), *kit.kinematics, next) ? 0 : kit.model->heuristic(next);
        ASSERT_LE(kit.model->heuristic(q), m.cost + h_next) << "seed " << seed << " action " << m.action;
      }
    }
  }
  EXPECT_GT(edges, 1000);
}

TEST(ManipulationLattice, MoveRepeatsWhatMovesEnumerates) {
  const Problem problem = fixtures::reach_problem(3, 1, 5);
  LatticeKit kit(problem);
  RandomStream random(5, {8});
  std::vector<LatticeModel::Move> moves;
  for (int walk = 0; walk < 20; ++walk) {
    const LatticeState s = random_walk(*kit.model, problem.robot.dof(), random, 15);
    kit.model->moves(s, moves);
    ASSERT_FALSE(moves.empty());
    for (const auto& m : moves) {
      LatticeModel::Move again;
      ASSERT_TRUE(kit.model->move(s, m.action, again));
      EXPECT_EQ(again.bins, m.bins);
      EXPECT_EQ(again.anchor, m.anchor);
      EXPECT_EQ(again.cost, m.cost);
      EXPECT_TRUE(problem.robot.within_limits(kit.model->configuration(m.anchor, m.bins)));
    }
  }
}

TEST(ManipulationLattice, ActionsDoNotDependOnObjectsOrRelevance) {
  const Problem empty = fixtures::reach_problem(0, 0, 9);
  Problem full = fixtures::reach_problem(10, 0, 9);
  full.task = empty.task;
  LatticeKit a(empty), b(full);
  const std::set<BannedEdge> none;
  const ManipulationLattice small(empty, *a.model, a.only({}), none, nullptr);
  const ManipulationLattice large(full, *b.model, b.all, none, nullptr);
  ManipulationLattice::Context ca{&a.evaluator, {}}, cb{&b.evaluator, {}};
  std::vector<search::LazyEdge> ea, eb;
  small.successors(ca, small.start(), ea);
  large.successors(cb, large.start(), eb);
  ASSERT_EQ(ea.size(), eb.size());
  for (std::size_t i = 0; i < ea.size(); ++i) {
    EXPECT_EQ(ea[i].action, eb[i].action);
    EXPECT_EQ(ea[i].cost, eb[i].cost);
    EXPECT_EQ(ea[i].heuristic, eb[i].heuristic);
  }
}

TEST(ManipulationLattice, ClassesMergePosesOfLessThanTheResolution) {
  const Problem problem = fixtures::reach_problem(2, 0, 3);
  LatticeKit kit(problem);
  const std::set<BannedEdge> none;
  const ManipulationLattice lattice(problem, *kit.model, kit.all, none, nullptr);
  LatticeState a = lattice.start();
  a.objects[0].p = {700000, -400000, 845000};
  LatticeState b = a, c = a, d = a;
  b.objects[0].p[0] += 1000;   // 1 mm
  c.objects[0].p[0] += 20000;  // 2 cm
  d.bins[0] += 1;
  EXPECT_FALSE(a == b);
  EXPECT_NE(lattice.hash(a), lattice.hash(b));
  EXPECT_TRUE(lattice.same_class(a, b));
  EXPECT_EQ(lattice.class_hash(a), lattice.class_hash(b));
  EXPECT_FALSE(lattice.same_class(a, c));
  EXPECT_FALSE(lattice.same_class(a, d));
  // A cylinder may spin about its axis, a box may not.
  LatticeState spun = a, turned = a;
  spun.objects[0] = quantise(fixtures::at(0.7, -0.4, 0.845, 1.0));
  turned.objects[1] = quantise(dequantise(a.objects[1]) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(lattice.same_class(a, spun));
  EXPECT_FALSE(lattice.same_class(a, turned));
}

TEST(ManipulationLattice, BannedEdgesAreInvalid) {
  const Problem problem = fixtures::reach_problem(0, 0, 3);
  LatticeKit kit(problem);
  std::set<BannedEdge> banned;
  const ManipulationLattice lattice(problem, *kit.model, kit.all, banned, nullptr);
  ManipulationLattice::Context context{&kit.evaluator, {}};
  std::vector<search::LazyEdge> edges;
  lattice.successors(context, lattice.start(), edges);
  int valid_action = -1;
  for (const auto& e : edges)
    if (lattice.evaluate(context, lattice.start(), e.action, nullptr).valid) valid_action = e.action;
  ASSERT_GE(valid_action, 0);
  banned.insert({lattice.start(), valid_action});
  EXPECT_FALSE(lattice.evaluate(context, lattice.start(), valid_action, nullptr).valid);
}

}  // namespace
}  // namespace mamo
