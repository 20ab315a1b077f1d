// Conflict-based search: paths of several agents that are never in each other's way.
#pragma once

#include <algorithm>
#include <memory>
#include <tuple>
#include <vector>

#include "mamo/search/agent_search.hpp"

namespace mamo::search {

struct CbsOptions {
  double suboptimality = 1.0;               // w >= 1; 1 is optimal
  std::int64_t max_expansions = 1'000'000;  // of all low-level searches together
  std::int64_t max_nodes = 100'000;         // of the high level, generated
  StopSource* stop = nullptr;
};

enum class CbsStatus { solved, unsolvable, budget, stopped };

struct CbsResult {
  CbsStatus status = CbsStatus::unsolvable;
  std::vector<AgentPath> paths;  // per agent, if solved; with status budget those of the node with the fewest conflicts
  Cost cost = 0;                 // sum over agents
  Cost lower_bound = 0;          // no solution is cheaper; cost <= w * lower_bound
  std::int64_t expansions = 0, nodes = 0;
  std::vector<int> stuck;  // agents that have no path even alone: proves that there is no solution
};

/// Conflict-based search (Sharon et al., 2015), with w > 1 enhanced CBS (Barer et al., 2014): focal search on both
/// levels, by number of conflicts. The sum of the agents' costs is at most w times the least. Bodies larger than a node
/// are split as in Li et al. (2019), "Multi-agent path finding for large agents": both children forbid everything that
/// has the conflict's witness, so a conflict of two large bodies takes few splits and no solution is lost.
/// Deviations: agents whose start is a goal without penalty are not searched for before a conflict moves them;
/// conflicts are split in order of (time, agents). Deterministic; agents are planned in order of number.
template <AgentDomain D>
class ConflictBasedSearch {
 public:
  ConflictBasedSearch(D& domain, const CbsOptions& options)
      : domain_(domain),
        options_(options),
        low_level_(domain, Weight(options.suboptimality), options.max_expansions, options.stop) {}

  CbsResult run() {
    CbsResult result;
    result.status = search(result);
    result.expansions = low_level_.expansions();
    result.nodes = static_cast<std::int64_t>(nodes_.size());
    if (result.status == CbsStatus::budget && !nodes_.empty()) {
      const auto& best = *std::ranges::min_element(
          nodes_, {}, [](const auto& node) { return std::tuple(node->conflict_count, node->cost); });
      for (const auto& path : best->paths) result.paths.push_back(*path);
      result.cost = best->cost;
    }
    return result;
  }

 private:
  using Low = AgentSearch<D>;
  using Constraint = typename Low::Constraint;
  /// Of two agents' paths: the first conflict, and how many there are.
  struct Conflict {
    int a, b;
    std::int32_t time;
    bool move;
    Cost count;
  };
  struct Node {
    std::int32_t parent = -1;
    Constraint constraint{};                              // that the parent does not have
    std::vector<std::shared_ptr<const AgentPath>> paths;  // shared with the parent but for the constrained agent's
    std::vector<Conflict> conflicts;                      // one entry per pair that has any
    Cost cost = 0, lower_bound = 0, conflict_count = 0;
  };
  struct Key {
    Cost conflicts, cost;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  CbsStatus search(CbsResult& result) {
    FocalQueue<Key> queue(Weight(options_.suboptimality));
    const CbsStatus root = add_root(queue, result.stuck);
    if (root != CbsStatus::solved) return root;
    while (!queue.empty()) {
      const std::int32_t id = queue.pop();
      if (at(id).conflicts.empty()) {
        for (const auto& path : at(id).paths) result.paths.push_back(*path);
        result.cost = at(id).cost;
        result.lower_bound = queue.lower_bound();
        return CbsStatus::solved;
      }
      if (static_cast<std::int64_t>(nodes_.size()) + 2 > options_.max_nodes) return CbsStatus::budget;
      for (const Constraint& constraint : split(at(id))) {
        const CbsStatus child = add_child(queue, id, constraint);
        if (child == CbsStatus::budget || child == CbsStatus::stopped) return child;
      }
    }
    return CbsStatus::unsolvable;
  }

  CbsStatus add_root(FocalQueue<Key>& queue, std::vector<int>& stuck) {
    const int n = domain_.agents();
    Node root;
    root.paths.resize(static_cast<std::size_t>(n));
    for (int a = 0; a < n; ++a)
      if (domain_.penalty(a, domain_.start(a)) == 0)
        root.paths[static_cast<std::size_t>(a)] =
            std::make_shared<const AgentPath>(AgentPath{{domain_.start(a)}, 0, 0});
    for (int a = 0; a < n; ++a) {
      if (root.paths[static_cast<std::size_t>(a)]) continue;
      AgentPath path;
      const CbsStatus status = plan(root, a, {}, path);
      if (status == CbsStatus::unsolvable) {
        stuck.push_back(a);
        continue;
      }
      if (status != CbsStatus::solved) return status;
      root.paths[static_cast<std::size_t>(a)] = std::make_shared<const AgentPath>(std::move(path));
    }
    if (!stuck.empty()) return CbsStatus::unsolvable;
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) note_conflicts(root, a, b);
    push(queue, std::move(root));
    return CbsStatus::solved;
  }

  CbsStatus add_child(FocalQueue<Key>& queue, std::int32_t parent, const Constraint& constraint) {
    const int agent = constraint.agent;
    Node child;
    child.parent = parent;
    child.constraint = constraint;
    child.paths = at(parent).paths;
    std::vector<const Constraint*> constraints{&constraint};
    for (std::int32_t id = parent; id >= 0; id = at(id).parent)
      if (at(id).constraint.agent == agent) constraints.push_back(&at(id).constraint);
    AgentPath path;
    const CbsStatus status = plan(child, agent, constraints, path);
    if (status != CbsStatus::solved) return status;
    auto& slot = child.paths[static_cast<std::size_t>(agent)];
    path.lower_bound = std::max(path.lower_bound, slot->lower_bound);
    slot = std::make_shared<const AgentPath>(std::move(path));
    for (const Conflict& c : at(parent).conflicts)
      if (c.a != agent && c.b != agent) child.conflicts.push_back(c);
    for (int b = 0; b < domain_.agents(); ++b)
      if (b != agent) note_conflicts(child, std::min(agent, b), std::max(agent, b));
    push(queue, std::move(child));
    return CbsStatus::solved;
  }

  CbsStatus plan(const Node& node, int agent, const std::vector<const Constraint*>& constraints, AgentPath& path) {
    std::vector<const AgentPath*> others;
    for (const auto& p : node.paths) others.push_back(p.get());
    others[static_cast<std::size_t>(agent)] = nullptr;
    switch (low_level_.run(agent, constraints, others, path)) {
      case Low::Outcome::found:
        return CbsStatus::solved;
      case Low::Outcome::none:
        return CbsStatus::unsolvable;
      case Low::Outcome::budget:
        return CbsStatus::budget;
      case Low::Outcome::stopped:
        break;
    }
    return CbsStatus::stopped;
  }

  void push(FocalQueue<Key>& queue, Node node) {
    for (const auto& path : node.paths) {
      node.cost += path->cost;
      node.lower_bound += path->lower_bound;
    }
    for (const Conflict& c : node.conflicts) node.conflict_count += c.count;
    queue.push(node.lower_bound, node.cost, {node.conflict_count, node.cost});
    nodes_.push_back(std::make_unique<const Node>(std::move(node)));
  }

  void note_conflicts(Node& node, int a, int b) {
    const AgentPath& p = *node.paths[static_cast<std::size_t>(a)];
    const AgentPath& q = *node.paths[static_cast<std::size_t>(b)];
    Conflict found{a, b, 0, false, 0};
    const auto note = [&](std::int32_t time, bool move) {
      if (found.count++ == 0) found.time = time, found.move = move;
    };
    const std::int32_t last = std::max({p.last(), q.last(), 1});
    for (std::int32_t t = 1; t <= last; ++t) {
      if (domain_.conflict(a, p.at(t), b, q.at(t))) note(t, false);
      if constexpr (HasMoveConflicts<D>)
        if (domain_.move_conflict(a, p.at(t - 1), p.at(t), b, q.at(t - 1), q.at(t))) note(t, true);
    }
    if (found.count > 0) node.conflicts.push_back(found);
  }

  /// The first conflict, as a constraint on either agent: every solution keeps one of the two.
  std::vector<Constraint> split(const Node& node) {
    const Conflict& first =
        *std::min_element(node.conflicts.begin(), node.conflicts.end(), [](const Conflict& x, const Conflict& y) {
          return std::tuple(x.time, x.move, x.a, x.b) < std::tuple(y.time, y.move, y.a, y.b);
        });
    std::vector<Constraint> out;
    for (const int agent : {first.a, first.b}) {
      const AgentPath& path = *node.paths[static_cast<std::size_t>(agent)];
      out.push_back({agent, first.time, first.move, path.at(first.time - 1), path.at(first.time), {}});
    }
    if (!first.move) out[0].witness = out[1].witness = domain_.witness(first.a, out[0].to, first.b, out[1].to);
    return out;
  }

  const Node& at(std::int32_t id) const { return *nodes_[static_cast<std::size_t>(id)]; }

  D& domain_;
  CbsOptions options_;
  Low low_level_;
  std::vector<std::unique_ptr<const Node>> nodes_;  // by number in the queue
};

/// Paths for all agents, of a cost within the suboptimality.
template <AgentDomain D>
CbsResult conflict_based_search(D& domain, const CbsOptions& options) {
  return ConflictBasedSearch<D>(domain, options).run();
}

}  // namespace mamo::search
