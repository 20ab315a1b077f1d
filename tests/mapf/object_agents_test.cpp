// What conflict-based search relies on: the properties that search::AgentDomain asks for, on random objects.
#include "mapf/object_agents.hpp"

#include <gtest/gtest.h>

#include "support/shelf_cases.hpp"

namespace mamo::mapf {
namespace {

using search::AgentNode;
using search::Cost;
using search::kUnreachable;

/// The agents of a shelf, some of them tilted.
struct Crowd {
  Crowd(int movables, std::uint64_t seed)
      : random(seed, {0x63726f77}),
        shelf(test::shelf_case(movables, 4, seed)),
        stage(shelf.problem.scene, shelf.target, options),
        region(shelf.region),
        agents(stage.grid(), options, make(), region, [this](const ObjectAgent& a) {
          return std::make_shared<const Surroundings>(
              stage.surroundings(a.footprint, stage.level_of(a.footprint, a.start)));
        }) {}

  std::vector<ObjectAgent> make() {
    std::vector<ObjectAgent> out;
    for (const ObjectId id : ObjectSet::of_kind(shelf.problem.scene, ObjectKind::movable).ids()) {
      Eigen::Isometry3d X = shelf.state.X_WO(id);
      if (random.below(2) == 0)
        X.rotate(Eigen::AngleAxisd(random.uniform(0, 1.6),
                                   Eigen::Vector3d(random.normal(), random.normal(), 0).normalized()));
      ObjectAgent a;
      a.object = id;
      a.footprint = footprint_of(shelf.problem.scene[id], X);
      a.start = X.translation().head<2>();
      a.start_cell = stage.grid().nearest(a.start);
      a.start_node = stage.grid().node(a.start_cell);
      a.starts_clear = !region.overlaps(a.footprint, a.start);
      out.push_back(std::move(a));
    }
    return out;
  }
  /// A cell within 12 of the node.
  AgentNode around(AgentNode n) {
    for (;;) {
      GridCell c = stage.grid().at(n);
      c.x += static_cast<std::int32_t>(random.below(25)) - 12;
      c.y += static_cast<std::int32_t>(random.below(25)) - 12;
      if (const AgentNode m = stage.grid().node(c); m >= 0) return m;
    }
  }

  RandomStream random;
  ObjectPathsOptions options;
  test::ShelfCase shelf;
  Stage stage;
  RegionShadow region;
  ObjectAgents agents;
};

TEST(ObjectAgents, TwoThatHaveTheWitnessOfAConflictConflict) {
  int conflicts = 0, points = 0, both = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Crowd crowd(8, seed);
    ObjectAgents& d = crowd.agents;
    for (int a = 0; a < d.agents(); ++a)
      for (int b = 0; b < d.agents(); ++b) {
        if (a == b) continue;
        for (int k = 0; k < 20; ++k) {
          const AgentNode m = crowd.around(d.start(b)), n = crowd.around(m);
          ASSERT_EQ(d.conflict(a, m, b, n), d.conflict(b, n, a, m));
          if (!d.conflict(a, m, b, n)) continue;
          ++conflicts;
          const ObjectAgents::Witness w = d.witness(a, m, b, n);
          points += w.agent[0] < 0;
          EXPECT_TRUE(d.violates(a, m, w));
          EXPECT_TRUE(d.violates(b, n, w));
          for (int j = 0; j < 10; ++j) {
            const AgentNode m2 = crowd.around(m), n2 = crowd.around(n);
            if (!d.violates(a, m2, w) || !d.violates(b, n2, w)) continue;
            ++both;
            EXPECT_TRUE(d.conflict(a, m2, b, n2));
          }
        }
      }
  }
  EXPECT_GT(conflicts, 100);
  EXPECT_GT(points, conflicts / 2);
  EXPECT_GT(both, 50);
}

TEST(ObjectAgents, TheHeuristicIsTheDistanceToTheCheapestGoal) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Crowd crowd(5, seed);
    ObjectAgents& d = crowd.agents;
    std::vector<search::AgentMove> moves;
    for (int a = 0; a < d.agents(); ++a)
      for (AgentNode n = 0; n < crowd.stage.grid().size(); n += 7) {
        if (d.heuristic(a, n) >= kUnreachable) continue;
        d.moves(a, n, moves);
        Cost best = d.penalty(a, n);
        for (const search::AgentMove& move : moves)
          if (move.to != n) best = std::min(best, move.cost + d.heuristic(a, move.to));
        EXPECT_EQ(d.heuristic(a, n), best);
      }
  }
}

}  // namespace
}  // namespace mamo::mapf
