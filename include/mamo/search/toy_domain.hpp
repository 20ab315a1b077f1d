// Domains without robots: a scripted random graph and a grid. For tests, benchmarks and examples of the concept.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/search/domain.hpp"

namespace mamo::search {

/// A node, and what the physics did on the way: edges may leave the same node with different labels.
struct ToyState {
  std::int32_t node = 0;
  std::int32_t label = 0;
  friend bool operator==(const ToyState&, const ToyState&) = default;
};

enum class ToyDelay { none, busy, sleep };

struct RandomGraphOptions {
  std::uint64_t seed = 1;
  int nodes = 50;
  int degree = 4;              // edges out of each node (parallel edges and self-loops included)
  int max_cost = 20;           // costs are uniform in 1..max_cost
  int goals = 1;               // node 0 is the start; goals are drawn among the others (or node 0 if there is one)
  double invalid = 0.3;        // chance of an edge to fail, drawn per (state, action)
  int labels = 1;              // > 1: the label of a child is drawn per (state, action) by the evaluation
  int class_size = 1;          // labels in one class
  double heuristic = 1.0;      // 0: blind; 1: exact distance in the graph without failures
  bool predict_child = false;  // known_child() answers where there is one label
  double layered = 0;          // > 0: edges of node n lead to n + 1 .. n + layered, mostly: long, narrow graphs
  // What an evaluation costs. The length is drawn per (state, action), like the outcome.
  ToyDelay delay = ToyDelay::none;
  double check_ms = 0.3;      // every evaluation
  double physics_rate = 0.1;  // chance of physics besides, which is what `charge` counts
  double physics_ms = 30;     // mean of a lognormal with sigma 1, cut to [1, 200]
  int throw_at_node = -1;     // evaluating an edge of this node throws std::runtime_error
};

/// Edge costs and targets are known (lazy edges); whether an edge holds, and its child's label, only evaluate() says.
/// The heuristic depends on the node alone and is consistent.
class RandomGraph {
 public:
  using State = ToyState;
  struct Context {
    std::int64_t evaluations = 0;
    std::uint64_t jitter = 0;    // not 0: sleeps random short times, to shake threads; changes no outcome
    StopSource* stop = nullptr;  // polled during delays; may be null
  };
  struct Edge {
    std::int32_t to;
    Cost cost;
  };

  explicit RandomGraph(const RandomGraphOptions& options);

  State start() const { return {0, 0}; }
  std::uint64_t hash(const State& s) const;
  std::uint64_t class_hash(const State& s) const { return hash({s.node, s.label / options_.class_size}); }
  bool same_class(const State& a, const State& b) const {
    return a.node == b.node && a.label / options_.class_size == b.label / options_.class_size;
  }
  bool is_goal(const State& s) const { return goal_[static_cast<std::size_t>(s.node)]; }
  Cost heuristic(const State& s) const { return h_[static_cast<std::size_t>(s.node)]; }
  void successors(Context&, const State& s, std::vector<LazyEdge>& edges) const;
  EdgeOutcome<State> evaluate(Context& context, const State& s, std::int32_t action,
                              const std::atomic<bool>* cancel) const;
  bool known_child(const State& s, std::int32_t action, State& child) const;

  /// The outcome without the delay. What evaluate() returns.
  EdgeOutcome<State> outcome(const State& s, std::int32_t action) const;
  /// Length of the scripted evaluation.
  double evaluation_ms(const State& s, std::int32_t action) const;
  const std::vector<Edge>& edges_of(std::int32_t node) const { return graph_[static_cast<std::size_t>(node)]; }
  const RandomGraphOptions& options() const { return options_; }

 private:
  void build_heuristic();

  RandomGraphOptions options_;
  std::vector<std::vector<Edge>> graph_;
  std::vector<bool> goal_;
  std::vector<Cost> h_;
};

/// A grid with walls, 8 moves, costs 10 and 14, octile heuristic; moves into walls are found out by evaluate().
/// `map` holds rows of equal length: '#' wall, 'S' start, 'G' goal (several allowed), else free.
class GridDomain {
 public:
  using State = ToyState;  // node = y * width + x
  struct Context {};

  explicit GridDomain(const std::vector<std::string>& map);

  State start() const { return start_; }
  std::uint64_t hash(const State& s) const;
  std::uint64_t class_hash(const State& s) const { return hash(s); }
  bool same_class(const State& a, const State& b) const { return a == b; }
  bool is_goal(const State& s) const { return at(s.node % width_, s.node / width_) == 'G'; }
  Cost heuristic(const State& s) const;
  void successors(Context&, const State& s, std::vector<LazyEdge>& edges) const;
  EdgeOutcome<State> evaluate(Context&, const State& s, std::int32_t action, const std::atomic<bool>*) const;
  bool known_child(const State& s, std::int32_t action, State& child) const;

 private:
  char at(int x, int y) const { return map_[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]; }

  std::vector<std::string> map_;
  int width_ = 0, height_ = 0;
  State start_;
  std::vector<std::array<int, 2>> goals_;
};

}  // namespace mamo::search
