// One suite over lazy and eager weighted A*: answers against Dijkstra, bounds, ties, limits.
#include "mamo/search/weighted_astar.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <ostream>

#include "support/search_reference.hpp"
#include "support/toy_graphs.hpp"

#include "mamo/search/lazy_weighted_astar.hpp"

namespace mamo::search {
namespace {

using Result = SearchResult<ToyState>;

struct Algorithm {
  std::string name;
  std::function<Result(const RandomGraph&, const SearchOptions&)> run;
  std::function<Result(const GridDomain&, const SearchOptions&)> run_grid;
};

template <class D>
Result lazy(const D& d, const SearchOptions& o) {
  typename D::Context context{};
  return lazy_weighted_astar(d, context, o);
}
template <class D>
Result eager(const D& d, const SearchOptions& o) {
  typename D::Context context{};
  return weighted_astar(d, context, o);
}

SearchOptions weight(double w) {
  SearchOptions o;
  o.weight = w;
  return o;
}

/// Fails unless the path is a path of the domain with the cost it claims.
void expect_sound(const RandomGraph& domain, const Result& result) {
  if (!result.found()) {
    EXPECT_TRUE(result.path.empty());
    return;
  }
  ToyState at = domain.start();
  Cost cost = 0;
  for (const auto& step : result.path) {
    ASSERT_EQ(step.parent, at);
    const auto outcome = domain.outcome(step.parent, step.action);
    ASSERT_TRUE(outcome.valid);
    ASSERT_EQ(outcome.child, step.child);
    ASSERT_EQ(domain.edges_of(at.node)[static_cast<std::size_t>(step.action)].cost, step.cost);
    cost += step.cost;
    at = step.child;
  }
  EXPECT_EQ(cost, result.cost);
  EXPECT_EQ(at, result.last);
  EXPECT_TRUE(domain.is_goal(at));
}

void PrintTo(const Algorithm& a, std::ostream* out) { *out << a.name; }

class WeightedAStar : public testing::TestWithParam<Algorithm> {
 protected:
  Result run(const RandomGraph& d, const SearchOptions& o) { return GetParam().run(d, o); }
};

TEST_P(WeightedAStar, FindsTheOptimumAtWeightOneAndKeepsTheBoundAboveIt) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.class_size = 1;  // no merging: the claim is about this lattice
    const RandomGraph domain(options);
    const auto best = reference::dijkstra(domain);
    for (const double w : {1.0, 1.5, 3.0, 10.0}) {
      const Result result = run(domain, weight(w));
      ASSERT_EQ(result.found(), best.has_value());
      ASSERT_FALSE(result.merged);
      expect_sound(domain, result);
      if (!best) {
        EXPECT_EQ(result.reason, EndReason::exhausted);
        continue;
      }
      ++found;
      EXPECT_EQ(result.bound, w);
      EXPECT_LE(static_cast<double>(result.cost), w * static_cast<double>(*best) + 1e-6);
      if (w == 1.0) {
        EXPECT_EQ(result.cost, *best);
      }
    }
  }
  EXPECT_GT(found, 2000);
}

TEST_P(WeightedAStar, SmallestFOverWeightIsALowerBoundWhenALimitStopsIt) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.class_size = 1;
    const RandomGraph domain(options);
    const auto best = reference::dijkstra(domain);
    for (int limit = 0; limit < 8; ++limit) {
      SearchOptions o = weight(3);
      (limit % 2 ? o.max_expansions : o.max_evaluations) = limit;
      const Result result = run(domain, o);
      if (best && !result.found()) {
        EXPECT_LE(result.open_min_f / 3.0, static_cast<double>(*best));
      }
    }
  }
}

TEST_P(WeightedAStar, MergedClassesAreReportedAndPathsStaySound) {
  int merged = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.labels = 4;
    options.class_size = 4;
    const RandomGraph domain(options);
    const Result result = run(domain, weight(1.5));
    expect_sound(domain, result);
    EXPECT_EQ(result.merged, result.counters.merged > 0);
    merged += result.merged;
  }
  EXPECT_GT(merged, 50);
}

TEST_P(WeightedAStar, RepeatsItselfExactly) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomGraph domain(random_toy(seed));
    const Result a = run(domain, weight(2)), b = run(domain, weight(2));
    EXPECT_EQ(a.order_hash, b.order_hash);
    EXPECT_EQ(a.counters, b.counters);
  }
}

TEST_P(WeightedAStar, CountersAddUp) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomGraph domain(random_toy(seed));
    const SearchCounters c = run(domain, weight(random_weight(seed))).counters;
    EXPECT_EQ(c.evaluations, c.valid + c.invalid);
    EXPECT_LE(c.duplicates, c.valid);
    std::int64_t tagged = 0;
    for (const auto& [tag, n] : c.tags) tagged += n;
    EXPECT_EQ(tagged, c.invalid);  // the toy domain tags what fails
  }
}

TEST_P(WeightedAStar, EndsWhenAllEdgesFail) {
  RandomGraphOptions options;
  options.invalid = 1.0;
  options.degree = 6;
  const RandomGraph domain(options);
  const Result result = run(domain, weight(3));
  EXPECT_EQ(result.reason, EndReason::exhausted);
  EXPECT_EQ(result.counters.expansions, 1);
  EXPECT_EQ(result.counters.valid, 0);
  EXPECT_GT(result.counters.invalid, 0);
}

TEST_P(WeightedAStar, AStartThatIsAGoalNeedsNoEdge) {
  RandomGraphOptions options;
  options.nodes = 1;
  const Result result = run(RandomGraph(options), weight(1));
  EXPECT_EQ(result.reason, EndReason::goal);
  EXPECT_TRUE(result.path.empty());
  EXPECT_EQ(result.cost, 0);
  EXPECT_EQ(result.counters.evaluations, 0);
}

TEST_P(WeightedAStar, LimitsCutThePrefixOfTheUnlimitedRun) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.physics_rate = 0.5;
    const RandomGraph domain(options);
    const Result whole = run(domain, weight(2));
    SearchOptions o = weight(2);
    o.max_evaluations = whole.counters.evaluations / 2;
    const Result half = run(domain, o);
    if (whole.counters.evaluations > 1) {
      EXPECT_EQ(half.reason, EndReason::limit_evaluations);
      EXPECT_EQ(half.counters.evaluations, o.max_evaluations);
    }
    o = weight(2);
    o.max_charge = whole.counters.charge / 2;
    const Result charged = run(domain, o);
    if (whole.counters.charge > 1) {
      EXPECT_EQ(charged.reason, EndReason::limit_charge);
      EXPECT_EQ(charged.counters.charge, o.max_charge);
    }
    o = weight(2);
    o.max_expansions = 1;
    EXPECT_LE(run(domain, o).counters.expansions, 1);
    o = weight(2);
    o.max_evaluations = whole.counters.evaluations;
    o.max_expansions = whole.counters.expansions;
    o.max_charge = whole.counters.charge + 1;
    if (whole.found()) {
      const Result again = run(domain, o);
      EXPECT_TRUE(again.found());
      EXPECT_EQ(again.order_hash, whole.order_hash);
    }
  }
}

TEST_P(WeightedAStar, ObeysAStopAndADeadline) {
  RandomGraphOptions options;
  options.nodes = 2000;
  options.heuristic = 0;
  options.delay = ToyDelay::sleep;
  options.check_ms = 1;
  options.physics_rate = 0;
  const RandomGraph domain(options);
  StopSource stop;
  stop.request(StopReason::interrupted);
  SearchOptions o;
  o.stop = &stop;
  EXPECT_EQ(run(domain, o).reason, EndReason::stopped);
  EXPECT_EQ(run(domain, o).counters.evaluations, 0);
  StopSource timed(0.03);
  o.stop = &timed;
  const auto begin = StopSource::Clock::now();
  EXPECT_EQ(run(domain, o).reason, EndReason::stopped);
  EXPECT_LT(StopSource::Clock::now() - begin, std::chrono::milliseconds(500));
}

TEST_P(WeightedAStar, ReportsProgressAndLetsExceptionsThrough) {
  RandomGraphOptions options;
  options.nodes = 300;
  options.heuristic = 0;
  SearchOptions o = weight(1);
  int calls = 0;
  o.on_progress = [&](const SearchProgress& p) { calls += p.evaluations >= 0; };
  run(RandomGraph(options), o);
  EXPECT_GT(calls, 3);
  options.throw_at_node = 0;
  EXPECT_THROW(run(RandomGraph(options), o), std::runtime_error);
  EXPECT_THROW(run(RandomGraph(options), weight(0.5)), std::invalid_argument);
}

TEST_P(WeightedAStar, WalksAroundTheWallsOfAGrid) {
  const GridDomain grid({"S.......", "######..", "G.......", "........"});
  const Result result = GetParam().run_grid(grid, weight(1));
  ASSERT_TRUE(result.found());
  EXPECT_EQ(result.cost, 10 * 10 + 14 * 2);
  EXPECT_EQ(result.cost, *reference::dijkstra(grid));
  const GridDomain closed({"S#G", "###"});
  EXPECT_EQ(GetParam().run_grid(closed, weight(3)).reason, EndReason::exhausted);
}

INSTANTIATE_TEST_SUITE_P(Both, WeightedAStar,
                         testing::Values(Algorithm{"lazy", lazy<RandomGraph>, lazy<GridDomain>},
                                         Algorithm{"eager", eager<RandomGraph>, eager<GridDomain>}),
                         [](const auto& instance) { return instance.param.name; });

TEST(ToyDomain, HeuristicIsConsistentOnEveryEdge) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const RandomGraph domain(random_toy(seed));
    RandomGraph::Context context;
    std::vector<LazyEdge> edges;
    for (std::int32_t n = 0; n < domain.options().nodes; ++n) {
      domain.successors(context, {n, 0}, edges);
      for (const LazyEdge& e : edges) {
        ASSERT_GT(e.cost, 0);
        const ToyState child = domain.outcome({n, 0}, e.action).child;
        ASSERT_EQ(domain.heuristic(child), e.heuristic);
        if (e.heuristic < kUnreachable) {
          ASSERT_LE(domain.heuristic({n, 0}), e.cost + e.heuristic) << "seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace mamo::search
