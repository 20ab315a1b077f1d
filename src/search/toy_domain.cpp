#include "mamo/search/toy_domain.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <queue>
#include <stdexcept>
#include <thread>

#include "mamo/common/random.hpp"
#include "mamo/search/toy_clutter.hpp"

namespace mamo::search {
namespace {

enum Purpose : std::uint64_t { kTopology = 1, kGoals, kOutcome, kLength };

RandomStream edge_stream(std::uint64_t seed, Purpose purpose, const ToyState& s, std::int32_t action) {
  return RandomStream(seed, {purpose, static_cast<std::uint64_t>(s.node), static_cast<std::uint64_t>(s.label),
                             static_cast<std::uint64_t>(action)});
}

}  // namespace

RandomGraph::RandomGraph(const RandomGraphOptions& options)
    : options_(options),
      graph_(static_cast<std::size_t>(options.nodes)),
      goal_(static_cast<std::size_t>(options.nodes), false) {
  const auto nodes = static_cast<std::uint64_t>(options.nodes);
  for (std::size_t n = 0; n < graph_.size(); ++n) {
    RandomStream random(options.seed, {kTopology, n});
    for (int k = 0; k < options.degree; ++k) {
      std::uint64_t to = random.below(nodes);
      if (options.layered > 0 && random.uniform() < 0.95) {
        to = std::min(nodes - 1, n + 1 + random.below(static_cast<std::uint64_t>(options.layered)));
      }
      const auto cost = static_cast<Cost>(1 + random.below(static_cast<std::uint64_t>(options.max_cost)));
      graph_[n].push_back({static_cast<std::int32_t>(to), cost});
    }
  }
  RandomStream random(options.seed, {kGoals});
  for (int k = 0; k < options.goals; ++k) {
    const bool last = options.layered > 0 || nodes == 1;
    goal_[last ? nodes - 1 : 1 + random.below(nodes - 1)] = true;
  }
  build_heuristic();
}

/// Distances to the nearest goal, failures ignored, scaled down; floor(scale * d) stays consistent for scale <= 1.
void RandomGraph::build_heuristic() {
  std::vector<std::vector<Edge>> reverse(graph_.size());
  for (std::size_t n = 0; n < graph_.size(); ++n) {
    for (const Edge& e : graph_[n]) {
      reverse[static_cast<std::size_t>(e.to)].push_back({static_cast<std::int32_t>(n), e.cost});
    }
  }
  h_.assign(graph_.size(), kUnreachable);
  using Item = std::pair<Cost, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (std::size_t n = 0; n < graph_.size(); ++n) {
    if (goal_[n]) h_[n] = 0, queue.push({0, static_cast<std::int32_t>(n)});
  }
  while (!queue.empty()) {
    const auto [d, n] = queue.top();
    queue.pop();
    if (d > h_[static_cast<std::size_t>(n)]) continue;
    for (const Edge& e : reverse[static_cast<std::size_t>(n)]) {
      Cost& known = h_[static_cast<std::size_t>(e.to)];
      if (d + e.cost < known) known = d + e.cost, queue.push({known, e.to});
    }
  }
  for (Cost& h : h_) {
    if (h < kUnreachable) h = static_cast<Cost>(std::floor(options_.heuristic * static_cast<double>(h)));
  }
}

std::uint64_t RandomGraph::hash(const State& s) const {
  return mix64(static_cast<std::uint64_t>(static_cast<std::uint32_t>(s.node)) << 32 |
               static_cast<std::uint32_t>(s.label));
}

void RandomGraph::successors(Context&, const State& s, std::vector<LazyEdge>& edges) const {
  edges.clear();
  std::int32_t action = 0;
  for (const Edge& e : edges_of(s.node)) edges.push_back({action++, e.cost, h_[static_cast<std::size_t>(e.to)]});
}

EdgeOutcome<ToyState> RandomGraph::outcome(const State& s, std::int32_t action) const {
  RandomStream random = edge_stream(options_.seed, kOutcome, s, action);
  EdgeOutcome<State> result;
  result.valid = random.uniform() >= options_.invalid;
  result.child.node = edges_of(s.node)[static_cast<std::size_t>(action)].to;
  result.child.label = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(options_.labels)));
  result.charge = random.uniform() < options_.physics_rate;
  result.work = 1 + action;
  result.tag = result.valid ? 0 : 1 + action % 3;
  return result;
}

double RandomGraph::evaluation_ms(const State& s, std::int32_t action) const {
  RandomStream random = edge_stream(options_.seed, kLength, s, action);
  if (outcome(s, action).charge == 0) return options_.check_ms;
  return options_.check_ms + std::clamp(options_.physics_ms * std::exp(random.normal() - 0.5), 1.0, 200.0);
}

EdgeOutcome<ToyState> RandomGraph::evaluate(Context& context, const State& s, std::int32_t action,
                                            const std::atomic<bool>* cancel) const {
  ++context.evaluations;
  if (s.node == options_.throw_at_node) throw std::runtime_error("toy domain: scripted exception");
  EdgeOutcome<State> result = outcome(s, action);
  if (options_.delay != ToyDelay::none) {
    result.cancelled = !spend(options_.delay, evaluation_ms(s, action), cancel, context.stop);
  }
  if (context.jitter != 0) {
    context.jitter = mix64(context.jitter);
    if (context.jitter % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(context.jitter >> 32 & 127));
    if (context.jitter % 4 == 1) std::this_thread::yield();
  }
  return result;
}

bool RandomGraph::known_child(const State& s, std::int32_t action, State& child) const {
  if (!options_.predict_child || options_.labels != 1) return false;
  child = {edges_of(s.node)[static_cast<std::size_t>(action)].to, 0};
  return true;
}

// --- the grid ---------------------------------------------------------------------------------------------

namespace {
constexpr int kDx[8] = {1, 0, -1, 0, 1, -1, -1, 1};
constexpr int kDy[8] = {0, 1, 0, -1, 1, 1, -1, -1};
}  // namespace

GridDomain::GridDomain(const std::vector<std::string>& map)
    : map_(map), width_(static_cast<int>(map.at(0).size())), height_(static_cast<int>(map.size())) {
  for (int y = 0; y < height_; ++y) {
    if (static_cast<int>(map_[static_cast<std::size_t>(y)].size()) != width_) {
      throw std::invalid_argument("grid rows differ in length");
    }
    for (int x = 0; x < width_; ++x) {
      if (at(x, y) == 'S') start_ = {y * width_ + x, 0};
      if (at(x, y) == 'G') goals_.push_back({x, y});
    }
  }
}

std::uint64_t GridDomain::hash(const State& s) const { return mix64(static_cast<std::uint64_t>(s.node)); }

Cost GridDomain::heuristic(const State& s) const {
  Cost best = kUnreachable;
  for (const auto& [x, y] : goals_) {
    const Cost dx = std::abs(s.node % width_ - x), dy = std::abs(s.node / width_ - y);
    best = std::min(best, 10 * std::max(dx, dy) + 4 * std::min(dx, dy));
  }
  return best;
}

void GridDomain::successors(Context&, const State& s, std::vector<LazyEdge>& edges) const {
  edges.clear();
  State child;
  for (std::int32_t a = 0; a < 8; ++a) {
    if (known_child(s, a, child)) edges.push_back({a, a < 4 ? 10 : 14, heuristic(child)});
  }
}

EdgeOutcome<ToyState> GridDomain::evaluate(Context&, const State& s, std::int32_t action,
                                           const std::atomic<bool>*) const {
  EdgeOutcome<State> result;
  const bool inside = known_child(s, action, result.child);
  result.valid = inside && at(result.child.node % width_, result.child.node / width_) != '#';
  return result;
}

bool GridDomain::known_child(const State& s, std::int32_t action, State& child) const {
  const int x = s.node % width_ + kDx[action], y = s.node / width_ + kDy[action];
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
  child = {y * width_ + x, 0};
  return true;
}

}  // namespace mamo::search
