#include "mamo/mapf/object_paths.hpp"

#include <algorithm>
#include <mutex>
#include <tuple>

#include "mapf/object_agents.hpp"

#include "mamo/search/conflict_based_search.hpp"

namespace mamo {
namespace {

using Eigen::Vector2d;
using mapf::Footprint;
using mapf::ObjectAgent;
using mapf::ObjectAgents;
using mapf::Surroundings;

/// Surroundings by the footprint that sees them. They are pure functions of the key, so what is kept and what is made
/// again shows in no result.
class SurroundingsCache {
 public:
  std::shared_ptr<const Surroundings> get(const mapf::Stage& stage, const ObjectAgent& agent,
                                          const QuantisedPose& pose) {
    const int level = stage.level_of(agent.footprint, agent.start);
    const Key key{agent.object, pose.q, pose.p[2], level};
    {
      const std::lock_guard lock(mutex_);
      if (const auto it = made_.find(key); it != made_.end()) return it->second;
    }
    auto made = std::make_shared<const Surroundings>(stage.surroundings(agent.footprint, level));
    const std::lock_guard lock(mutex_);
    if (made_.size() >= kMost) made_.clear();
    return made_.emplace(key, std::move(made)).first->second;
  }

 private:
  static constexpr std::size_t kMost = 2000;  // of some 10 kB each
  using Key = std::tuple<ObjectId, std::array<std::int32_t, 4>, std::int32_t, int>;
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const Surroundings>> made_;
};

/// May the agent go straight from p to q, as far as what stays is concerned?
bool line_of_sight(const ObjectAgents& agents, int a, const Vector2d& p, const Vector2d& q, double step) {
  const int n = std::max(1, static_cast<int>(std::ceil((q - p).norm() / step)));
  for (int k = 1; k <= n; ++k)
    if (!agents.allowed(a, p + (q - p) * (static_cast<double>(k) / n))) return false;
  return true;
}

/// The way points of nodes [first, last], but for the first: from each the farthest that is in sight.
void append_in_sight(const ObjectAgents& agents, int a, const std::vector<search::AgentNode>& nodes, std::size_t first,
                     std::size_t last, double step, std::vector<Vector2d>& points) {
  while (first < last) {
    std::size_t next = last;
    while (next > first + 1 && !line_of_sight(agents, a, points.back(), agents.position(a, nodes[next]), step)) --next;
    points.push_back(agents.position(a, nodes[next]));
    first = next;
  }
}

std::vector<Vector2d> shortcut(const ObjectAgents& agents, int a, const std::vector<search::AgentNode>& nodes,
                               double step) {
  std::vector<Vector2d> points{agents.position(a, nodes.front())};
  // Who makes way and comes back would not move at all on a straight line: the farthest point stays.
  std::size_t via = nodes.size() - 1;
  if (nodes.back() == nodes.front())
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if ((agents.position(a, nodes[i]) - points[0]).norm() > (agents.position(a, nodes[via]) - points[0]).norm())
        via = i;
  append_in_sight(agents, a, nodes, 0, via, step, points);
  append_in_sight(agents, a, nodes, via, nodes.size() - 1, step, points);
  return points;
}

/// A few crowds need far more than the suboptimality allows until it is known that nothing cheaper exists: rounds of
/// an eighth, two and five eighths of the budget, each with twice the suboptimality of the one before.
search::CbsResult search_in_rounds(ObjectAgents& agents, const ObjectPathsOptions& options, StopSource* stop) {
  search::CbsResult found;
  std::int64_t expansions = 0, nodes = 0;
  double suboptimality = options.suboptimality;
  for (const int eighths : {1, 2, 5}) {
    search::CbsOptions round;
    round.suboptimality = suboptimality;
    round.max_expansions = options.max_expansions * eighths / 8;
    round.max_nodes = std::int64_t{options.max_nodes} * eighths / 8;
    round.stop = stop;
    found = search::conflict_based_search(agents, round);
    found.expansions = expansions += found.expansions;
    found.nodes = nodes += found.nodes;
    if (found.status != search::CbsStatus::budget) break;
    suboptimality *= 2;
  }
  return found;
}

}  // namespace

struct ObjectPathFinder::Impl {
  const Problem& problem;
  ObjectId target;
  ObjectPathsOptions options;
  mapf::Stage stage;
  mutable SurroundingsCache cache;

  std::vector<ObjectAgent> agents(const WorldState& state, const mapf::RegionShadow& region,
                                  const std::map<ObjectId, InvalidGoals>& invalid) const {
    std::vector<ObjectAgent> out;
    for (std::size_t i = 0; i < problem.scene.size(); ++i) {
      const ObjectId id(i);
      if (!problem.scene[id].movable() || id == target) continue;
      ObjectAgent agent;
      agent.object = id;
      const Eigen::Isometry3d X_WO = state.X_WO(id);
      agent.footprint = mapf::footprint_of(problem.scene[id], X_WO);
      agent.start = X_WO.translation().head<2>();
      agent.start_cell = stage.grid().nearest(agent.start);
      const std::int32_t node = stage.grid().node(agent.start_cell);
      const bool can_move = node >= 0 && stage.level_of(agent.footprint, agent.start) >= 0;
      agent.start_node = can_move ? node : stage.grid().size();
      if (const auto it = invalid.find(id); it != invalid.end()) agent.invalid = &it->second;
      agent.starts_clear = !region.overlaps(agent.footprint, agent.start);
      out.push_back(std::move(agent));
    }
    return out;
  }

  ObjectPath object_path(const ObjectAgents& agents, int a, std::vector<search::AgentNode> nodes) const {
    while (nodes.size() > 1 && nodes.back() == nodes[nodes.size() - 2]) nodes.pop_back();
    ObjectPath out;
    out.object = agents.agent(a).object;
    for (const search::AgentNode n : nodes)
      out.cells.push_back(n < stage.grid().size() ? stage.grid().at(n) : agents.agent(a).start_cell);
    out.goal = out.cells.back();
    if (nodes.size() > 1) out.points = shortcut(agents, a, nodes, options.cell / 5);
    return out;
  }
};

ObjectPathFinder::ObjectPathFinder(const Problem& problem, ObjectId target, const ObjectPathsOptions& options)
    : impl_(new Impl{problem, target, options, mapf::Stage(problem.scene, target, options), {}}) {}

ObjectPathFinder::~ObjectPathFinder() = default;

ObjectPathsResult ObjectPathFinder::solve(const WorldState& state, const VoxelVolume& region,
                                          const std::map<ObjectId, InvalidGoals>& invalid, StopSource* stop) const {
  mapf::RegionShadow shadow(region);
  ObjectAgents agents(impl_->stage.grid(), impl_->options, impl_->agents(state, shadow, invalid), shadow,
                      [&](const ObjectAgent& a) { return impl_->cache.get(impl_->stage, a, state[a.object]); });
  const search::CbsResult found = search_in_rounds(agents, impl_->options, stop);

  ObjectPathsResult out;
  out.solved = found.status == search::CbsStatus::solved;
  out.stopped = found.status == search::CbsStatus::stopped;
  out.budget_used_up = found.status == search::CbsStatus::budget;
  out.cost = found.cost;
  out.low_level_expansions = found.expansions;
  out.high_level_nodes = found.nodes;
  for (const int a : found.stuck) out.stuck.push_back(agents.agent(a).object);
  for (std::size_t a = 0; a < found.paths.size(); ++a) {
    ObjectPath path = impl_->object_path(agents, static_cast<int>(a), found.paths[a].nodes);
    if (path.cells.size() > 1) out.paths.push_back(std::move(path));
  }
  return out;
}

bool ObjectPathFinder::clear_of(const VoxelVolume& region, ObjectId object, const WorldState& state) const {
  const Eigen::Isometry3d X_WO = state.X_WO(object);
  const Footprint footprint = mapf::footprint_of(impl_->problem.scene[object], X_WO);
  return !mapf::RegionShadow(region).overlaps(footprint, X_WO.translation().head<2>());
}

}  // namespace mamo
