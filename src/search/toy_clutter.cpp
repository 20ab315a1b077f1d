#include "mamo/search/toy_clutter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "mamo/common/random.hpp"

namespace mamo::search {

namespace {

using Clock = std::chrono::steady_clock;

bool asked_to_stop(const std::atomic<bool>* cancel, StopSource* stop) {
  return (cancel && cancel->load(std::memory_order_relaxed)) || (stop && stop->stopped());
}

/// A fixed amount of arithmetic for each millisecond: the same work however often the thread is interrupted.
bool compute(double ms, const std::atomic<bool>* cancel, StopSource* stop) {
  constexpr double kStepsPerMs = 200'000;
  volatile std::uint64_t sink = 1;
  std::uint64_t x = sink;
  for (auto left = static_cast<std::int64_t>(ms * kStepsPerMs); left > 0; left -= 20'000) {
    if (asked_to_stop(cancel, stop)) return false;
    for (std::int64_t i = std::min<std::int64_t>(left, 20'000); i > 0; --i) x = mix64(x);
  }
  sink = x;
  return true;
}

bool sleep(double ms, const std::atomic<bool>* cancel, StopSource* stop) {
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(ms));
  while (Clock::now() < end) {
    if (asked_to_stop(cancel, stop)) return false;
    std::this_thread::sleep_until(std::min(end, Clock::now() + std::chrono::microseconds(500)));
  }
  return true;
}

}  // namespace

bool spend(ToyDelay delay, double ms, const std::atomic<bool>* cancel, StopSource* stop) {
  if (delay == ToyDelay::none) return true;
  return delay == ToyDelay::sleep ? sleep(ms, cancel, stop) : compute(ms, cancel, stop);
}

namespace {

constexpr Cost kStep[4] = {0, 10, 14, 17};  // by the number of axes moved

RandomStream edge_stream(const ToyClutterOptions& o, std::uint64_t purpose, const ToyState& s, std::int32_t action) {
  return RandomStream(o.seed, {purpose, static_cast<std::uint64_t>(s.node), static_cast<std::uint64_t>(s.label),
                               static_cast<std::uint64_t>(action)});
}

}  // namespace

ToyClutter::ToyClutter(const ToyClutterOptions& options) : options_(options) {
  const int n = options.side;
  cells_.assign(static_cast<std::size_t>(n * n * n), Cell::free);
  goal_ = n * n * n - 1;
  RandomStream random(options.seed, {0x636c7574});
  const auto ball = [&](double mean_radius, Cell kind) {
    const double x = random.uniform(0, n), y = random.uniform(0, n), z = random.uniform(0, n);
    const double radius = mean_radius * random.uniform(0.6, 1.4);
    for (std::int32_t node = 0; node < goal_; ++node) {
      const auto [px, py, pz] = place(node);
      if (std::hypot(px - x, py - y, pz - z) < radius) cells_[static_cast<std::size_t>(node)] = kind;
    }
  };
  for (int i = 0; i < options.movables; ++i) ball(options.movable_radius, Cell::movable);
  for (int i = 0; i < options.walls; ++i) ball(options.wall_radius, Cell::wall);
  for (std::int32_t node = 0; node <= goal_; ++node) {
    const auto [x, y, z] = place(node);
    const int from_goal = 3 * (n - 1) - x - y - z;
    if (std::min(x + y + z, from_goal) < 4) cells_[static_cast<std::size_t>(node)] = Cell::free;
  }
}

std::array<int, 3> ToyClutter::place(std::int32_t node) const {
  const int n = options_.side;
  return {node % n, node / n % n, node / n / n};
}

std::int32_t ToyClutter::neighbour(std::int32_t node, std::int32_t action) const {
  const int code = action < 13 ? action : action + 1;  // 13 is (0, 0, 0)
  const auto [x, y, z] = place(node);
  const int n = options_.side, nx = x + code % 3 - 1, ny = y + code / 3 % 3 - 1, nz = z + code / 9 - 1;
  if (std::min({nx, ny, nz}) < 0 || std::max({nx, ny, nz}) >= n) return -1;
  return (nz * n + ny) * n + nx;
}

std::uint64_t ToyClutter::hash(const State& s) const {
  return mix64(static_cast<std::uint64_t>(static_cast<std::uint32_t>(s.node)) << 32 |
               static_cast<std::uint32_t>(s.label));
}

Cost ToyClutter::heuristic(const State& s) const {
  auto [x, y, z] = place(s.node);
  std::array<Cost, 3> d{options_.side - 1 - x, options_.side - 1 - y, options_.side - 1 - z};
  std::sort(d.begin(), d.end());
  return kStep[3] * d[0] + kStep[2] * (d[1] - d[0]) + kStep[1] * (d[2] - d[1]);
}

void ToyClutter::successors(Context&, const State& s, std::vector<LazyEdge>& edges) const {
  edges.clear();
  for (std::int32_t action = 0; action < 26; ++action) {
    const std::int32_t to = neighbour(s.node, action);
    if (to < 0) continue;
    const int code = action < 13 ? action : action + 1;
    const int axes = (code % 3 != 1) + (code / 3 % 3 != 1) + (code / 9 != 1);
    edges.push_back({action, kStep[axes], heuristic({to, 0})});
  }
}

EdgeOutcome<ToyState> ToyClutter::outcome(const State& s, std::int32_t action) const {
  EdgeOutcome<State> result;
  result.child = {neighbour(s.node, action), s.label};
  result.work = 1;
  const Cell cell = cells_[static_cast<std::size_t>(result.child.node)];
  result.valid = cell != Cell::wall;
  result.tag = !result.valid;
  if (cell != Cell::movable) return result;
  RandomStream random = edge_stream(options_, 1, s, action);
  result.charge = 1;
  result.valid = random.uniform() >= options_.push_fails;
  result.tag = result.valid ? 0 : 2;
  result.child.label = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(options_.labels)));
  return result;
}

double ToyClutter::evaluation_ms(const State& s, std::int32_t action) const {
  double ms = options_.check_ms;
  if (cells_[static_cast<std::size_t>(neighbour(s.node, action))] == Cell::movable) {
    RandomStream random = edge_stream(options_, 2, s, action);
    ms += std::clamp(options_.physics_ms * std::exp(random.normal() - 0.5), 1.0, 200.0);
  }
  return ms * options_.scale;
}

EdgeOutcome<ToyState> ToyClutter::evaluate(Context& context, const State& s, std::int32_t action,
                                           const std::atomic<bool>* cancel) const {
  ++context.evaluations;
  EdgeOutcome<State> result = outcome(s, action);
  if (options_.delay != ToyDelay::none) {
    result.cancelled = !spend(options_.delay, evaluation_ms(s, action), cancel, context.stop);
  }
  return result;
}

}  // namespace mamo::search
