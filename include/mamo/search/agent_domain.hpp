// What conflict-based search needs to know of its agents. No word of robots here.
#pragma once

#include <concepts>
#include <cstdint>
#include <vector>

#include "mamo/search/domain.hpp"

namespace mamo::search {

/// Where an agent is: an index >= 0 that only the domain understands. Every move takes one step of time.
using AgentNode = std::int32_t;

struct AgentMove {
  AgentNode to = 0;
  Cost cost = 1;  // > 0
};

/// Agents 0 .. agents()-1 on graphs of their own that are in each other's way. Methods may cache (a domain belongs to
/// one search), but what they answer is a pure function of their arguments.
///
///   moves(a, n, out)        clears and fills out, in a fixed order; waiting is a move like any other (to n itself).
///   penalty(a, n)           >= 0: agent a may end at n for good, for that cost (the edge to the pseudo-goal);
///                           kUnreachable: n is no goal of a.
///   heuristic(a, n)         consistent lower bound on the cost of ending from n, penalty included;
///                           kUnreachable: no way.
///   conflict(a, m, b, n)    a at m and b at n at the same time will not do. Symmetric. Bodies may be larger than a
///                           node: what overlaps is the domain's business.
///   witness(a, m, b, n)     of such a conflict: something that no two agents may have at once, e.g. a point of
///                           space inside both bodies.
///   violates(a, n, w)       a at n has it. If a at m violates w and b at n violates w, then (a, m) and (b, n)
///                           conflict, whenever w is a witness of a conflict of a and b; and (a, m), (b, n) violate
///                           their own witness. The more nodes violate, the faster the search.
template <class D>
concept AgentDomain = requires(D d, int agent, AgentNode node, std::vector<AgentMove> moves,
                               const typename D::Witness witness) {
  { d.agents() } -> std::convertible_to<int>;
  { d.start(agent) } -> std::convertible_to<AgentNode>;
  {d.moves(agent, node, moves)};
  { d.penalty(agent, node) } -> std::convertible_to<Cost>;
  { d.heuristic(agent, node) } -> std::convertible_to<Cost>;
  { d.conflict(agent, node, agent, node) } -> std::convertible_to<bool>;
  { d.witness(agent, node, agent, node) } -> std::convertible_to<typename D::Witness>;
  { d.violates(agent, node, witness) } -> std::convertible_to<bool>;
};

/// Optional: move_conflict(a, m, m2, b, n, n2): a moving from m to m2 while b moves from n to n2 will not do although
/// neither end does harm (two agents that swap).
template <class D>
concept HasMoveConflicts = requires(D d, int agent, AgentNode node) {
  { d.move_conflict(agent, node, node, agent, node, node) } -> std::convertible_to<bool>;
};

/// Optional: preference(a, n) >= 0, what it is worth to stay away from n: decides among paths of a cost that the
/// suboptimality allows, after conflicts. preference_to_go(a, n): an estimate of its sum from n to a goal.
template <class D>
concept HasPreference = requires(D d, int agent, AgentNode node) {
  { d.preference(agent, node) } -> std::convertible_to<Cost>;
  { d.preference_to_go(agent, node) } -> std::convertible_to<Cost>;
};

/// An agent's way: nodes[t] at time t; after the last one it stays where it is, for good and at no cost.
struct AgentPath {
  std::vector<AgentNode> nodes;
  Cost cost = 0;         // of the moves, and the penalty of the end
  Cost lower_bound = 0;  // no path that keeps the constraints is cheaper

  AgentNode at(std::int32_t t) const {
    const auto i = static_cast<std::size_t>(t);
    return i < nodes.size() ? nodes[i] : nodes.back();
  }
  std::int32_t last() const { return static_cast<std::int32_t>(nodes.size()) - 1; }
};

}  // namespace mamo::search
