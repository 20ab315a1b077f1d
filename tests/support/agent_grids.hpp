// Grid worlds for multi-agent path finding, random ones, and the optimum of small ones by brute force.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <queue>
#include <vector>

#include "mamo/common/random.hpp"
#include "mamo/search/agent_domain.hpp"

namespace mamo::test {

/// Agents are squares of `body` x `body` cells, named by their lowest corner, that step on a 4-connected grid or wait.
class AgentGrid {
 public:
  using Cell = std::array<int, 2>;
  /// The cell of space that both bodies cover.
  using Witness = Cell;
  struct Goal {
    Cell cell;
    search::Cost penalty;
  };

  AgentGrid(int width, int height, int body = 1)
      : width_(width), height_(height), body_(body), blocked_(static_cast<std::size_t>(width * height), 0) {}
  void block(Cell c) { blocked_[static_cast<std::size_t>(node(c))] = 1; }
  void add_agent(Cell start, const std::vector<Goal>& goals) { agents_.push_back({start, goals}); }
  void forbid_swaps() { swaps_forbidden_ = true; }

  search::AgentNode node(Cell c) const { return c[1] * width_ + c[0]; }
  Cell cell(search::AgentNode n) const { return {n % width_, n / width_}; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// The body fits into the grid and onto no blocked cell.
  bool free(Cell c) const {
    for (int x = c[0]; x < c[0] + body_; ++x)
      for (int y = c[1]; y < c[1] + body_; ++y)
        if (x < 0 || y < 0 || x >= width_ || y >= height_ || blocked_[static_cast<std::size_t>(node({x, y}))])
          return false;
    return true;
  }

  int agents() const { return static_cast<int>(agents_.size()); }
  search::AgentNode start(int a) const { return node(agents_[static_cast<std::size_t>(a)].start); }
  void moves(int, search::AgentNode n, std::vector<search::AgentMove>& out) const {
    out.clear();
    const Cell c = cell(n);
    for (const Cell& d : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}})
      if (const Cell to{c[0] + d[0], c[1] + d[1]}; free(to)) out.push_back({node(to), 1});
  }
  search::Cost penalty(int a, search::AgentNode n) const {
    for (const Goal& g : agents_[static_cast<std::size_t>(a)].goals)
      if (node(g.cell) == n) return g.penalty;
    return search::kUnreachable;
  }
  /// Blind to what is blocked, so that searching without goal has to end by itself.
  search::Cost heuristic(int a, search::AgentNode n) const {
    search::Cost best = search::kUnreachable;
    const Cell c = cell(n);
    for (const Goal& g : agents_[static_cast<std::size_t>(a)].goals)
      best = std::min(best, g.penalty + std::abs(c[0] - g.cell[0]) + std::abs(c[1] - g.cell[1]));
    return best;
  }
  bool conflict(int, search::AgentNode m, int, search::AgentNode n) const {
    const Cell c = cell(m), d = cell(n);
    return std::abs(c[0] - d[0]) < body_ && std::abs(c[1] - d[1]) < body_;
  }
  Witness witness(int, search::AgentNode m, int, search::AgentNode n) const {
    const Cell c = cell(m), d = cell(n);
    return {std::max(c[0], d[0]), std::max(c[1], d[1])};
  }
  bool violates(int, search::AgentNode n, const Witness& w) const {
    const Cell c = cell(n);
    return w[0] >= c[0] && w[0] < c[0] + body_ && w[1] >= c[1] && w[1] < c[1] + body_;
  }
  bool move_conflict(int, search::AgentNode from, search::AgentNode to, int, search::AgentNode other_from,
                     search::AgentNode other_to) const {
    return swaps_forbidden_ && from != to && from == other_to && to == other_from;
  }

 private:
  struct Agent {
    Cell start;
    std::vector<Goal> goals;
  };
  int width_, height_, body_;
  bool swaps_forbidden_ = false;
  std::vector<char> blocked_;
  std::vector<Agent> agents_;
};

/// One to three goals per agent, some with penalties; starts do not overlap. May have no solution.
inline AgentGrid random_grid(int agents, int side, int body, bool forbid_swaps, std::uint64_t seed) {
  RandomStream random(seed, {0x6d617066, static_cast<std::uint64_t>(agents), static_cast<std::uint64_t>(side),
                             static_cast<std::uint64_t>(body)});
  AgentGrid grid(side, side, body);
  if (forbid_swaps) grid.forbid_swaps();
  for (int k = 0; k < side * side / (4 * body * body); ++k)
    grid.block({static_cast<int>(random.below(static_cast<std::uint64_t>(side))),
                static_cast<int>(random.below(static_cast<std::uint64_t>(side)))});
  const auto place = [&] {
    AgentGrid::Cell c{0, 0};
    for (int k = 0; k < 200; ++k) {
      c = {static_cast<int>(random.below(static_cast<std::uint64_t>(side))),
           static_cast<int>(random.below(static_cast<std::uint64_t>(side)))};
      if (grid.free(c)) break;
    }
    return c;
  };
  for (int a = 0; a < agents; ++a) {
    AgentGrid::Cell start = place();
    const auto taken = [&] {
      for (int b = 0; b < grid.agents(); ++b)
        if (grid.conflict(a, grid.node(start), b, grid.start(b))) return true;
      return false;
    };
    for (int k = 0; k < 200 && taken(); ++k) start = place();
    std::vector<AgentGrid::Goal> goals;
    for (std::uint64_t k = 0, n = 1 + random.below(3); k < n; ++k)
      goals.push_back({place(), static_cast<search::Cost>(random.below(2) * random.below(5))});
    grid.add_agent(start, goals);
  }
  return grid;
}

/// The least sum of costs by Dijkstra over all agents at once (uniform moves of cost 1): a state is where everybody
/// is and who has ended for good. kUnreachable: none.
inline search::Cost joint_optimum(AgentGrid& grid) {
  struct Joint {
    std::vector<search::AgentNode> at;
    std::vector<char> ended;
    auto operator<=>(const Joint&) const = default;
  };
  const auto n = static_cast<std::size_t>(grid.agents());
  std::map<Joint, search::Cost> cost;
  using Entry = std::pair<search::Cost, Joint>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](const Joint& j, search::Cost g) {
    const auto [it, fresh] = cost.emplace(j, g);
    if (!fresh && it->second <= g) return;
    it->second = g;
    search::Cost h = 0;
    for (std::size_t a = 0; a < n; ++a)
      if (!j.ended[a]) h += grid.heuristic(static_cast<int>(a), j.at[a]);
    open.push({g + h, j});
  };
  Joint start;
  for (std::size_t a = 0; a < n; ++a) start.at.push_back(grid.start(static_cast<int>(a)));
  start.ended.assign(n, 0);
  reach(start, 0);
  std::vector<std::vector<search::AgentMove>> moves(n);
  while (!open.empty()) {
    const auto [f, j] = open.top();
    open.pop();
    const search::Cost g = cost.at(j);
    if (std::all_of(j.ended.begin(), j.ended.end(), [](char e) { return e != 0; })) return g;
    for (std::size_t a = 0; a < n; ++a) {  // ending takes no time
      const search::Cost penalty = grid.penalty(static_cast<int>(a), j.at[a]);
      if (j.ended[a] || penalty >= search::kUnreachable) continue;
      Joint next = j;
      next.ended[a] = 1;
      reach(next, g + penalty);
    }
    for (std::size_t a = 0; a < n; ++a) {
      grid.moves(static_cast<int>(a), j.at[a], moves[a]);
      if (j.ended[a]) moves[a] = {{j.at[a], 0}};
    }
    std::vector<std::size_t> choice(n, 0);
    for (;;) {
      Joint next = j;
      search::Cost step = 0;
      for (std::size_t a = 0; a < n; ++a) next.at[a] = moves[a][choice[a]].to, step += moves[a][choice[a]].cost;
      bool valid = step > 0;
      for (std::size_t a = 0; a < n && valid; ++a)
        for (std::size_t b = a + 1; b < n && valid; ++b)
          valid =
              !grid.conflict(static_cast<int>(a), next.at[a], static_cast<int>(b), next.at[b]) &&
              !grid.move_conflict(static_cast<int>(a), j.at[a], next.at[a], static_cast<int>(b), j.at[b], next.at[b]);
      if (valid) reach(next, g + step);
      std::size_t a = 0;
      while (a < n && ++choice[a] == moves[a].size()) choice[a++] = 0;
      if (a == n) break;
    }
  }
  return search::kUnreachable;
}

}  // namespace mamo::test
