// Conflict-based search against a joint-space oracle on small random grids, and on published instances.
#include "mamo/search/conflict_based_search.hpp"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>

#include "support/agent_grids.hpp"
#include "support/shared_data.hpp"

namespace mamo::search {
namespace {

using test::AgentGrid;
using test::joint_optimum;
using test::random_grid;

CbsResult solve(AgentGrid& grid, double w, std::int64_t max_nodes = 20'000) {
  CbsOptions options;
  options.suboptimality = w;
  options.max_nodes = max_nodes;
  return conflict_based_search(grid, options);
}

/// Fails unless the paths are paths of the agents, cost what they claim, end in goals and never conflict.
void expect_valid(AgentGrid& grid, const CbsResult& result) {
  ASSERT_EQ(static_cast<int>(result.paths.size()), grid.agents());
  Cost total = 0;
  std::int32_t last = 0;
  for (int a = 0; a < grid.agents(); ++a) {
    const AgentPath& path = result.paths[static_cast<std::size_t>(a)];
    ASSERT_EQ(path.nodes.front(), grid.start(a));
    Cost cost = grid.penalty(a, path.nodes.back());
    ASSERT_LT(cost, kUnreachable);
    for (std::int32_t t = 0; t < path.last(); ++t) {
      std::vector<AgentMove> moves;
      grid.moves(a, path.at(t), moves);
      const auto move = std::find_if(moves.begin(), moves.end(), [&](auto& m) { return m.to == path.at(t + 1); });
      ASSERT_NE(move, moves.end());
      cost += move->cost;
    }
    EXPECT_EQ(cost, path.cost);
    total += cost;
    last = std::max(last, path.last());
  }
  EXPECT_EQ(total, result.cost);
  for (std::int32_t t = 1; t <= last; ++t)
    for (int a = 0; a < grid.agents(); ++a)
      for (int b = a + 1; b < grid.agents(); ++b) {
        const AgentPath &p = result.paths[static_cast<std::size_t>(a)], &q = result.paths[static_cast<std::size_t>(b)];
        EXPECT_FALSE(grid.conflict(a, p.at(t), b, q.at(t))) << "agents " << a << ", " << b << " at time " << t;
        EXPECT_FALSE(grid.move_conflict(a, p.at(t - 1), p.at(t), b, q.at(t - 1), q.at(t)));
      }
}

struct Sample {
  int agents, side, body, count;
  bool swaps;
};

class AgainstTheOracle : public testing::TestWithParam<Sample> {};

TEST_P(AgainstTheOracle, TheCostIsWithinTheWeightOfTheOptimum) {
  const Sample s = GetParam();
  int solvable = 0, constrained = 0, solved_optimally = 0;
  for (int seed = 0; seed < s.count; ++seed) {
    AgentGrid grid = random_grid(s.agents, s.side, s.body, s.swaps, static_cast<std::uint64_t>(seed));
    const Cost optimum = joint_optimum(grid);
    if (optimum >= kUnreachable) {  // conflict-based search alone need not end here
      EXPECT_NE(solve(grid, 1.0, 100).status, CbsStatus::solved) << "seed " << seed;
      continue;
    }
    ++solvable;
    for (const double w : {1.0, 1.2, 2.0}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", w " + std::to_string(w));
      const CbsResult result = solve(grid, w, 10'000);
      if (result.status == CbsStatus::budget) continue;  // corridors: exponentially many equal detours
      ASSERT_EQ(result.status, CbsStatus::solved);
      if (w == 1.0) {
        EXPECT_EQ(result.cost, optimum);
        ++solved_optimally;
        constrained += result.nodes > 1;
      }
      EXPECT_LE(static_cast<double>(result.cost), w * static_cast<double>(optimum) + 1e-9);
      EXPECT_LE(result.lower_bound, optimum);
      EXPECT_GE(w * static_cast<double>(result.lower_bound) + 1e-9, static_cast<double>(result.cost));
      expect_valid(grid, result);
    }
  }
  EXPECT_GT(solvable, s.count / 3);
  EXPECT_GE(solved_optimally, solvable * 9 / 10);
  EXPECT_GT(constrained, s.count / 20);
}

INSTANTIATE_TEST_SUITE_P(Grids, AgainstTheOracle,
                         testing::Values(Sample{2, 4, 1, 300, false}, Sample{2, 4, 1, 300, true},
                                         Sample{3, 3, 1, 100, false}, Sample{3, 3, 1, 100, true},
                                         Sample{2, 6, 2, 300, false}, Sample{2, 8, 3, 80, false},
                                         Sample{3, 6, 2, 60, false}),
                         [](const auto& i) {
                           return std::to_string(i.param.agents) + "AgentsOfBody" + std::to_string(i.param.body) +
                                  "OnSide" + std::to_string(i.param.side) + (i.param.swaps ? "NoSwaps" : "");
                         });

TEST(ConflictBasedSearch, AnAgentWithoutPathIsNamedAndProvesThatThereIsNoSolution) {
  AgentGrid grid(3, 3);
  grid.add_agent({0, 0}, {{{2, 2}, 0}});
  grid.add_agent({0, 2}, {{{2, 0}, 0}});
  for (const int y : {0, 1, 2}) grid.block({1, y});
  const CbsResult result = solve(grid, 1.0);
  EXPECT_EQ(result.status, CbsStatus::unsolvable);
  EXPECT_THAT(result.stuck, testing::ElementsAre(0, 1));
}

TEST(ConflictBasedSearch, AnAgentAtItsGoalMakesWayAndOnlyThenCostsExpansions) {
  AgentGrid grid(3, 2);  // agent 1 stands at its goal, in the way of agent 0 or not
  grid.add_agent({0, 0}, {{{2, 0}, 0}});
  grid.add_agent({1, 0}, {{{1, 0}, 0}, {{1, 1}, 0}});
  grid.block({0, 1});
  const CbsResult result = solve(grid, 1.0);
  ASSERT_EQ(result.status, CbsStatus::solved);
  EXPECT_EQ(result.cost, 3);
  expect_valid(grid, result);

  AgentGrid free(3, 2);
  free.add_agent({0, 1}, {{{2, 1}, 0}});
  free.add_agent({1, 0}, {{{1, 0}, 0}});
  const CbsResult alone = solve(free, 1.0);
  EXPECT_EQ(alone.expansions, 3);  // agent 0's alone: the end is the third
  EXPECT_EQ(alone.paths[1].nodes, std::vector<AgentNode>{free.start(1)});
}

TEST(ConflictBasedSearch, APenaltyMovesTheEndElsewhere) {
  AgentGrid grid(5, 1);
  grid.add_agent({0, 0}, {{{1, 0}, 4}, {{3, 0}, 0}});
  EXPECT_EQ(solve(grid, 1.0).paths[0].nodes.back(), grid.node({3, 0}));
  AgentGrid other(5, 1);
  other.add_agent({0, 0}, {{{1, 0}, 1}, {{3, 0}, 0}});
  EXPECT_EQ(solve(other, 1.0).cost, 2);
}

TEST(ConflictBasedSearch, BudgetsAndStopRequestsEndIt) {
  AgentGrid grid = random_grid(3, 3, 1, false, 7);
  CbsOptions options;
  options.max_expansions = 1;
  EXPECT_EQ(conflict_based_search(grid, options).status, CbsStatus::budget);
  StopSource stop;
  stop.request(StopReason::interrupted);
  options.max_expansions = 1000;
  options.stop = &stop;
  EXPECT_EQ(conflict_based_search(grid, options).status, CbsStatus::stopped);
}

/// libMultiRobotPlanning's format.
AgentGrid read_instance(const std::string& path) {
  const YAML::Node file = YAML::LoadFile(path);
  const auto cell = [](const YAML::Node& n) { return std::array<int, 2>{n[0].as<int>(), n[1].as<int>()}; };
  AgentGrid grid(file["map"]["dimensions"][0].as<int>(), file["map"]["dimensions"][1].as<int>());
  grid.forbid_swaps();
  for (const YAML::Node& obstacle : file["map"]["obstacles"]) grid.block(cell(obstacle));
  for (const YAML::Node& agent : file["agents"]) grid.add_agent(cell(agent["start"]), {{cell(agent["goal"]), 0}});
  return grid;
}

TEST(ConflictBasedSearch, SolvesThePublishedInstances) {
  MAMO_SHARED_OR_SKIP(folder, "mapf");
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.insert(entry.path().string());
  int solved = 0, optimal = 0;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    AgentGrid grid = read_instance(file);
    const CbsResult result = solve(grid, 1.5, 5'000);
    const CbsResult best = solve(grid, 1.0, 300);
    if (result.status == CbsStatus::solved) ++solved, expect_valid(grid, result);
    if (best.status == CbsStatus::solved) {
      ++optimal;
      expect_valid(grid, best);
      EXPECT_EQ(best.cost, best.lower_bound);
      EXPECT_LE(result.lower_bound, best.cost);
      EXPECT_EQ(result.status, CbsStatus::solved);
      EXPECT_LE(static_cast<double>(result.cost), 1.5 * static_cast<double>(best.cost));
    }
  }
  std::printf("%zu instances: %d solved within 1.5, %d optimally\n", files.size(), solved, optimal);
  EXPECT_EQ(solved, static_cast<int>(files.size()));
  EXPECT_GE(optimal, static_cast<int>(files.size()) * 8 / 10);
}

}  // namespace
}  // namespace mamo::search
