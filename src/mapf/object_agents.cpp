#include "mapf/object_agents.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;
using search::AgentNode;
using search::Cost;
using search::kUnreachable;

constexpr double kRounding = 1e-9;  // m
constexpr double kTouching = 1e-3;  // m: closer than this at the start is touching
constexpr int kPenaltyReach = 2;    // cells, in x and y each

std::size_t index(AgentNode n) { return static_cast<std::size_t>(n); }

/// How close (m) two bodies may come that were at `start_distance` at the start.
double least_distance(double start_distance, bool near_start, double cell) {
  if (start_distance > kTouching) return -kRounding;
  return std::min(0.0, start_distance) - (near_start ? cell / 2 : 0.0) - kRounding;
}

}  // namespace

ObjectAgents::ObjectAgents(const CellGrid& grid, const ObjectPathsOptions& options, std::vector<ObjectAgent> agents,
                           RegionShadow& region, SurroundingsOf surroundings_of)
    : grid_(grid),
      options_(options),
      agents_(std::move(agents)),
      region_(region),
      surroundings_of_(std::move(surroundings_of)),
      pairs_(agents_.size() * agents_.size()) {}

bool ObjectAgents::near_start(int a, const Vector2d& p) const {
  return (p - agent(a).start).lpNorm<Eigen::Infinity>() <= 1.5 * grid_.cell() + kRounding;
}

bool ObjectAgents::allowed(int a, const Vector2d& p) const {
  const ObjectAgent::Field& f = *agent(a).field;
  if (!f.surroundings->supported(p)) return false;
  const bool near = near_start(a, p);
  for (std::size_t i = 0; i < f.surroundings->obstacles.size(); ++i) {
    const Obstacle& o = f.surroundings->obstacles[i];
    if (o.near(p, 0) && o.distance(p) < least_distance(f.start_distance[i], near, grid_.cell())) return false;
  }
  return true;
}

void ObjectAgents::allow_what_the_start_allows(int a, ObjectAgent::Field& f) const {
  bool touching = false;
  for (const Obstacle& o : f.surroundings->obstacles) {
    f.start_distance.push_back(o.distance(agent(a).start));
    touching = touching || f.start_distance.back() <= kTouching;
  }
  if (touching)
    for (AgentNode n = 0; n < grid_.size(); ++n)
      if (f.cost[index(n)] == Surroundings::kBlocked && allowed(a, grid_.centre(grid_.at(n))))
        f.cost[index(n)] = Surroundings::kContact;
  std::uint8_t& start = f.cost[index(agent(a).start_node)];
  if (start == Surroundings::kBlocked) start = Surroundings::kContact;
}

/// EM4M_FACTS section 4, less the one that every goal costs there.
Cost ObjectAgents::penalty_at(const ObjectAgent& agent, const GridCell& cell) const {
  if (!agent.invalid) return 0;
  if (agent.invalid->contains(cell)) return kUnreachable;
  if (!options_.neighbour_penalties || cell == agent.start_cell) return 0;  // who stays is not pushed
  double sum = 0;
  for (int dx = -kPenaltyReach; dx <= kPenaltyReach; ++dx)
    for (int dy = -kPenaltyReach; dy <= kPenaltyReach; ++dy) {
      const auto it = agent.invalid->find({cell.x + dx, cell.y + dy});
      if (it != agent.invalid->end()) sum += it->second / std::ceil(std::hypot(dx, dy));
    }
  return sum > 0 ? static_cast<Cost>(std::ceil(sum - kRounding)) - 1 : 0;
}

const ObjectAgent::Field& ObjectAgents::field(int a) {
  ObjectAgent& self = agents_[static_cast<std::size_t>(a)];
  if (self.field) return *self.field;
  ObjectAgent::Field& f = self.field.emplace();
  f.surroundings = surroundings_of_(self);
  f.cost = f.surroundings->cost;
  allow_what_the_start_allows(a, f);
  const std::vector<std::uint8_t> in_region = region_.overlapping_cells(self.footprint, grid_);
  f.penalty.assign(f.cost.size(), kUnreachable);
  std::vector<Cost> cheapest(f.cost.size(), kUnreachable);
  for (AgentNode n = 0; n < grid_.size(); ++n) {
    const bool at_start = n == self.start_node;
    if (at_start ? !self.starts_clear : in_region[index(n)] || f.cost[index(n)] == Surroundings::kBlocked) continue;
    f.penalty[index(n)] = penalty_at(self, grid_.at(n));
    if (f.penalty[index(n)] < kUnreachable) cheapest[index(n)] = 0;
  }
  f.to_go = flood(f.penalty, f.cost, true);
  f.cost_to_go = flood(cheapest, f.cost, false);
  return f;
}

/// Dijkstra from all seeds at once, against the moves: entering a cell costs 1 (unit) or its cost. Buckets by cost.
std::vector<Cost> ObjectAgents::flood(const std::vector<Cost>& seeds, const std::vector<std::uint8_t>& cost,
                                      bool unit) const {
  std::vector<Cost> out(seeds.size(), kUnreachable);
  std::vector<std::vector<AgentNode>> buckets;
  const auto reach = [&](AgentNode n, Cost c) {
    if (c >= out[index(n)]) return;
    out[index(n)] = c;
    if (static_cast<std::size_t>(c) >= buckets.size()) buckets.resize(static_cast<std::size_t>(c) + 16);
    buckets[static_cast<std::size_t>(c)].push_back(n);
  };
  for (AgentNode n = 0; n < grid_.size(); ++n)
    if (seeds[index(n)] < kUnreachable) reach(n, seeds[index(n)]);
  for (std::size_t c = 0; c < buckets.size(); ++c)
    for (std::size_t k = 0; k < buckets[c].size(); ++k) {
      const AgentNode n = buckets[c][k];
      if (out[index(n)] != static_cast<Cost>(c)) continue;
      const Cost next = static_cast<Cost>(c) + (unit ? 1 : cost[index(n)]);
      const GridCell cell = grid_.at(n);
      for (const GridCell& to : {GridCell{cell.x + 1, cell.y}, GridCell{cell.x, cell.y + 1},
                                 GridCell{cell.x - 1, cell.y}, GridCell{cell.x, cell.y - 1}})
        if (const AgentNode m = grid_.node(to); m >= 0 && cost[index(m)] != Surroundings::kBlocked) reach(m, next);
    }
  return out;
}

void ObjectAgents::moves(int a, AgentNode n, std::vector<search::AgentMove>& out) {
  out.clear();
  out.push_back({n, 1});
  if (n == grid_.size()) return;
  const ObjectAgent::Field& f = field(a);
  const GridCell cell = grid_.at(n);
  for (const GridCell& to : {GridCell{cell.x + 1, cell.y}, GridCell{cell.x, cell.y + 1}, GridCell{cell.x - 1, cell.y},
                             GridCell{cell.x, cell.y - 1}})
    if (const AgentNode m = grid_.node(to); m >= 0 && f.cost[index(m)] != Surroundings::kBlocked) out.push_back({m, 1});
}

Cost ObjectAgents::penalty(int a, AgentNode n) {
  const ObjectAgent& self = agent(a);
  if (n == self.start_node) return self.starts_clear ? penalty_at(self, self.start_cell) : kUnreachable;
  return field(a).penalty[index(n)];
}

Cost ObjectAgents::heuristic(int a, AgentNode n) {
  if (n == grid_.size()) return penalty(a, n);
  return field(a).to_go[index(n)];
}

Cost ObjectAgents::preference(int a, AgentNode n) { return n == grid_.size() ? 0 : field(a).cost[index(n)]; }

Cost ObjectAgents::preference_to_go(int a, AgentNode n) {
  return n == grid_.size() ? 0 : field(a).cost_to_go[index(n)];
}

const ObjectAgents::Pair& ObjectAgents::pair(int a, int b) {
  std::optional<Pair>& slot = pairs_[static_cast<std::size_t>(a) * agents_.size() + static_cast<std::size_t>(b)];
  if (!slot) {
    slot.emplace();
    slot->shapes = obstacle_shapes(agent(b).footprint, agent(a).footprint);
    slot->start_distance = signed_distance(slot->shapes, agent(a).start - agent(b).start);
  }
  return *slot;
}

bool ObjectAgents::conflict(int a, AgentNode m, int b, AgentNode n) {
  if (a > b) return conflict(b, n, a, m);
  const Vector2d p = position(a, m), q = position(b, n);
  const double reach = agent(a).footprint.reach + agent(b).footprint.reach;
  if ((p - q).squaredNorm() >= reach * reach) return false;
  const Pair& pair = this->pair(a, b);
  const bool near = near_start(a, p) && near_start(b, q);
  return signed_distance(pair.shapes, p - q) < least_distance(pair.start_distance, near, grid_.cell());
}

ObjectAgents::Witness ObjectAgents::witness(int a, AgentNode m, int b, AgentNode n) {
  Witness out;
  // Those that touch at the start may have points in common later: only the places themselves will do.
  if (pair(std::min(a, b), std::max(a, b)).start_distance > kTouching) {
    const Vector2d p = position(a, m), q = position(b, n);
    Vector2d height, common;
    for (const Prism& x : agent(a).footprint.prisms)
      for (const Prism& y : agent(b).footprint.prisms)
        if (common_height(x, y, height) && common_point(x.shadow, p, y.shadow, q, common)) {
          out.p_W << common, (height[0] + height[1]) / 2;
          return out;
        }
  }
  out.agent[0] = a, out.node[0] = m;
  out.agent[1] = b, out.node[1] = n;
  return out;
}

bool ObjectAgents::violates(int a, AgentNode n, const Witness& w) const {
  if (w.agent[0] >= 0) return (a == w.agent[0] && n == w.node[0]) || (a == w.agent[1] && n == w.node[1]);
  const Vector2d p = w.p_W.head<2>() - position(a, n);
  for (const Prism& prism : agent(a).footprint.prisms) {
    // Both bodies reach beyond the point on either side by half of what counts as common height.
    const double margin = kLeastCommonHeight / 2;
    if (w.p_W.z() - margin <= prism.low || w.p_W.z() + margin >= prism.high) continue;
    if (prism.shadow.signed_distance(p) < -kRounding) return true;
  }
  return false;
}

}  // namespace mamo::mapf
