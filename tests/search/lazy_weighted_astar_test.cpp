// Lazy weighted A* commits exactly what the text of the algorithm says, in that order.
#include "mamo/search/lazy_weighted_astar.hpp"

#include <gmock/gmock.h>

#include "support/recording_domain.hpp"
#include "support/search_reference.hpp"
#include "support/toy_graphs.hpp"

#include "mamo/search/weighted_astar.hpp"

namespace mamo::search {
namespace {

SearchResult<ToyState> run(const RandomGraph& domain, double w) {
  RandomGraph::Context context;
  SearchOptions o;
  o.weight = w;
  return lazy_weighted_astar(domain, context, o);
}

TEST(LazyWeightedAStar, CommitsTheSameEvaluationsAsTheReferenceInTheSameOrder) {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.predict_child = false;  // the reference evaluates everything
    const RecordingGraph domain(options);
    const double w = random_weight(seed);
    const auto expected = reference::lazy_weighted_astar(domain, std::llround(1000 * w));
    RandomGraph::Context context;
    SearchOptions o;
    o.weight = w;
    const auto result = lazy_weighted_astar(domain, context, o);
    ASSERT_EQ(domain.log.size(), expected.events.size());
    for (std::size_t i = 0; i < domain.log.size(); ++i) {
      ASSERT_EQ(reference::key(domain.log[i].parent), expected.events[i].parent);
      ASSERT_EQ(domain.log[i].action, expected.events[i].action);
      ASSERT_EQ(domain.log[i].valid, expected.events[i].valid);
    }
    EXPECT_EQ(result.found(), expected.found);
    EXPECT_EQ(result.cost, expected.cost);
    EXPECT_EQ(result.merged, expected.merged);
  }
}

TEST(LazyWeightedAStar, KnownChildrenSaveEvaluationsAndChangeNoPath) {
  std::int64_t saved = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraphOptions options = random_toy(seed);
    options.labels = 1;
    options.predict_child = false;
    const auto without = run(RandomGraph(options), 3);
    options.predict_child = true;
    const auto with = run(RandomGraph(options), 3);
    EXPECT_EQ(with.cost, without.cost);
    EXPECT_EQ(with.reason, without.reason);
    EXPECT_EQ(with.counters.expansions, without.counters.expansions);
    EXPECT_LE(with.counters.evaluations, without.counters.evaluations);
    saved += with.counters.known_duplicates;
  }
  EXPECT_GT(saved, 1000);
}

TEST(LazyWeightedAStar, EvaluatesLessThanEagerWeightedAStar) {
  std::int64_t lazy = 0, eager = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomGraphOptions options;
    options.seed = seed;
    options.nodes = 200;
    options.degree = 8;
    options.heuristic = 0.9;
    const RandomGraph domain(options);
    RandomGraph::Context a, b;
    SearchOptions o;
    o.weight = 3;
    lazy += lazy_weighted_astar(domain, a, o).counters.evaluations;
    eager += weighted_astar(domain, b, o).counters.evaluations;
  }
  EXPECT_LT(2 * lazy, eager);
}

TEST(OpenList, OrderIsTotalAndStrict) {
  RandomStream random(7, {});
  std::vector<OpenEntry> entries;
  for (std::int64_t seq = 0; seq < 60; ++seq) {
    OpenEntry e;
    e.f = static_cast<Cost>(random.below(3));
    e.g = static_cast<Cost>(random.below(3));
    e.seq = seq;
    entries.push_back(e);
  }
  for (const OpenEntry& a : entries) {
    for (const OpenEntry& b : entries) {
      EXPECT_EQ(a.before(b) + b.before(a), a.seq == b.seq ? 0 : 1);
      for (const OpenEntry& c : entries) {
        if (a.before(b) && b.before(c)) {
          EXPECT_TRUE(a.before(c));
        }
      }
    }
  }
  OpenList open;
  for (const OpenEntry& e : entries) open.push(e);
  OpenEntry last = open.top();
  for (open.pop(); !open.empty(); open.pop()) {
    EXPECT_TRUE(last.before(open.top()));
    last = open.top();
  }
}

TEST(OpenList, WeightIsHeldInThousandths) {
  EXPECT_EQ(Weight(1.5).f(10, 20), 10'000 + 30'000);
  EXPECT_EQ(Weight(10).value(), 10.0);
  EXPECT_THROW(Weight(0.999), std::invalid_argument);
  EXPECT_THROW(Weight(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace mamo::search
