// A toy with the shape of planning among movables: walls that mislead the heuristic, clutter that needs "physics".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mamo/search/toy_domain.hpp"

namespace mamo::search {

struct ToyClutterOptions {
  std::uint64_t seed = 1;
  int side = 24;                               // cells along each of the three axes
  int walls = 10, movables = 14;               // balls of random place and size
  double wall_radius = 5, movable_radius = 4;  // mean (cells)
  int labels = 6;                              // what physics leaves behind; 1: nothing
  double push_fails = 0.5;                     // chance of an edge inside a movable to fail, by physics
  ToyDelay delay = ToyDelay::none;
  double check_ms = 0.3;   // every evaluation
  double physics_ms = 30;  // inside a movable; lognormal with sigma 1, cut to [1, 200]
  double scale = 1;        // of both
};

/// Cells of a cube, 26 moves, from one corner region to the opposite one. A move into a wall is found invalid; one
/// into a movable needs physics, may fail, and changes the label. Heuristic: distance without walls (consistent).
class ToyClutter {
 public:
  using State = ToyState;
  using Context = RandomGraph::Context;

  explicit ToyClutter(const ToyClutterOptions& options);

  State start() const { return {0, 0}; }
  std::uint64_t hash(const State& s) const;
  std::uint64_t class_hash(const State& s) const { return hash(s); }
  bool same_class(const State& a, const State& b) const { return a == b; }
  bool is_goal(const State& s) const { return s.node == goal_; }
  Cost heuristic(const State& s) const;
  void successors(Context&, const State& s, std::vector<LazyEdge>& edges) const;
  EdgeOutcome<State> evaluate(Context& context, const State& s, std::int32_t action,
                              const std::atomic<bool>* cancel) const;

  EdgeOutcome<State> outcome(const State& s, std::int32_t action) const;
  double evaluation_ms(const State& s, std::int32_t action) const;
  const ToyClutterOptions& options() const { return options_; }

 private:
  enum class Cell : std::uint8_t { free, wall, movable };
  std::array<int, 3> place(std::int32_t node) const;
  std::int32_t neighbour(std::int32_t node, std::int32_t action) const;  // -1 outside

  ToyClutterOptions options_;
  std::vector<Cell> cells_;
  std::int32_t goal_ = 0;
};

/// Spends `ms` asleep, or as much arithmetic as takes about that long, looking at the flag and the stop source at least
/// every half millisecond; false when stopped.
bool spend(ToyDelay delay, double ms, const std::atomic<bool>* cancel, StopSource* stop);

}  // namespace mamo::search
