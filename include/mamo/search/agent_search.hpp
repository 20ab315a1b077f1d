// The low level of conflict-based search: one agent's path in space and time under constraints.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "mamo/common/hash.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/search/agent_domain.hpp"
#include "mamo/search/focal_queue.hpp"

namespace mamo::search {

/// The agent must not be at a node that violates the witness at `time`; a move constraint: must not move from `from`
/// to `to` so that it arrives at `time`.
template <class Witness>
struct AgentConstraint {
  int agent = -1;
  std::int32_t time = 0;
  bool move = false;
  AgentNode from = 0, to = 0;
  Witness witness{};
};

/// (node, time) -> number of a state. Open addressing; cleared in the time of its size.
class SpaceTimeIndex {
 public:
  void clear() {
    keys_.assign(1024, kFree);
    values_.resize(keys_.size());
    size_ = 0;
  }
  /// The slot of the key, -1 in it if it is new.
  std::int32_t& operator()(AgentNode node, std::int32_t time) {
    if (2 * (size_ + 1) > keys_.size()) grow();
    return slot((static_cast<std::uint64_t>(static_cast<std::uint32_t>(time)) << 32) |
                static_cast<std::uint32_t>(node));
  }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  std::int32_t& slot(std::uint64_t key) {
    std::size_t i = mix64(key) & (keys_.size() - 1);
    while (keys_[i] != key && keys_[i] != kFree) i = (i + 1) & (keys_.size() - 1);
    if (keys_[i] == kFree) {
      keys_[i] = key;
      values_[i] = -1;
      ++size_;
    }
    return values_[i];
  }
  void grow() {
    const std::vector<std::uint64_t> keys = std::move(keys_);
    const std::vector<std::int32_t> values = std::move(values_);
    keys_.assign(2 * keys.size(), kFree);
    values_.resize(keys_.size());
    size_ = 0;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (keys[i] != kFree) slot(keys[i]) = values[i];
  }

  std::size_t size_ = 0;
  std::vector<std::uint64_t> keys_;
  std::vector<std::int32_t> values_;
};

/// Focal A* over (node, time). The path costs at most w times the cheapest that keeps the constraints; among those
/// that are cheap enough, few conflicts with the others' paths come first, then little preference cost. Times after the
/// last constraint and the last move of the others are one, so a search without goal ends.
template <AgentDomain D>
class AgentSearch {
 public:
  using Constraint = AgentConstraint<typename D::Witness>;
  enum class Outcome { found, none, budget, stopped };

  AgentSearch(D& domain, Weight weight, std::int64_t max_expansions, StopSource* stop)
      : domain_(domain), weight_(weight), max_expansions_(max_expansions), stop_(stop) {}

  /// others[i]: path of agent i, null if it has none yet (and for `agent` itself).
  Outcome run(int agent, const std::vector<const Constraint*>& constraints, const std::vector<const AgentPath*>& others,
              AgentPath& out) {
    prepare(agent, constraints, others);
    const AgentNode start = domain_.start(agent);
    const Cost h = domain_.heuristic(agent, start);
    if (h >= kUnreachable) return Outcome::none;
    FocalQueue<Key> queue(weight_);
    add(queue, {start, 0, -1, 0, 0, 0}, h);
    while (!queue.empty()) {
      if (expansions_ >= max_expansions_) return Outcome::budget;
      if (stop_ && expansions_ % 64 == 0 && stop_->stopped()) return Outcome::stopped;
      const std::int32_t id = queue.pop();
      const State state = states_[static_cast<std::size_t>(id)];
      if (state.node == kEnd) {
        trace(state, out);
        out.lower_bound = queue.lower_bound();
        return Outcome::found;
      }
      ++expansions_;
      expand(queue, id, state);
    }
    return Outcome::none;
  }

  std::int64_t expansions() const { return expansions_; }

 private:
  static constexpr AgentNode kEnd = -1;  // the pseudo-goal
  struct State {
    AgentNode node;
    std::int32_t time;
    std::int32_t parent;
    Cost g;
    Cost conflicts, preference;  // on the way to here
  };
  struct Key {
    Cost conflicts, preference, f, h;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  void prepare(int agent, const std::vector<const Constraint*>& constraints,
               const std::vector<const AgentPath*>& others) {
    agent_ = agent;
    constraints_ = constraints;
    others_.clear();
    last_ = 0;
    for (const Constraint* c : constraints) last_ = std::max(last_, c->time);
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (!others[i]) continue;
      others_.push_back({static_cast<int>(i), others[i]});
      last_ = std::max(last_, others[i]->last());
    }
    states_.clear();
    index_.clear();
  }

  void expand(FocalQueue<Key>& queue, std::int32_t id, const State& state) {
    const Cost penalty = domain_.penalty(agent_, state.node);
    if (penalty < kUnreachable && may_end(state.node, state.time))
      add(queue, {kEnd, state.time, id, state.g + penalty, state.conflicts + conflicts_after(state), state.preference},
          0);
    domain_.moves(agent_, state.node, moves_);
    // Times beyond last_ are alike: they share one number.
    const std::int32_t time = std::min(state.time + 1, last_ + 1);
    for (const AgentMove& move : moves_) {
      const Cost h = domain_.heuristic(agent_, move.to);
      if (h >= kUnreachable || forbidden(state.node, move.to, state.time + 1)) continue;
      const std::int32_t known = index_(move.to, time);
      const Cost g = state.g + move.cost;
      if (known >= 0 && g > states_[static_cast<std::size_t>(known)].g) continue;
      State next{move.to,         time, id, g, state.conflicts + conflicts_at(state.node, move.to, state.time + 1),
                 state.preference};
      if constexpr (HasPreference<D>) next.preference += domain_.preference(agent_, move.to);
      add(queue, next, h);
    }
  }

  /// Pushes the state unless a known one at its place and time is as good.
  void add(FocalQueue<Key>& queue, const State& state, Cost h) {
    const auto id = static_cast<std::int32_t>(states_.size());
    if (state.node != kEnd) {
      std::int32_t& slot = index_(state.node, state.time);
      if (slot >= 0) {
        const State& known = states_[static_cast<std::size_t>(slot)];
        const bool better = std::pair(state.conflicts, state.preference) < std::pair(known.conflicts, known.preference);
        // An expanded state is expanded again only for a cheaper way to it, which the bound needs.
        if (state.g > known.g || (state.g == known.g && !(better && queue.remove(slot)))) return;
        queue.remove(slot);
      }
      slot = id;
    }
    Cost preference = state.preference;
    if constexpr (HasPreference<D>)
      if (state.node != kEnd) preference += domain_.preference_to_go(agent_, state.node);
    states_.push_back(state);
    queue.push(state.g + h, state.g + h, {state.conflicts, preference, state.g + h, h});
  }

  bool forbidden(AgentNode from, AgentNode to, std::int32_t time) {
    if (time > last_) return false;
    for (const Constraint* c : constraints_)
      if (c->time == time && (c->move ? c->from == from && c->to == to : domain_.violates(agent_, to, c->witness)))
        return true;
    return false;
  }
  bool may_end(AgentNode node, std::int32_t time) {
    for (const Constraint* c : constraints_)
      if (c->time > time && !c->move && domain_.violates(agent_, node, c->witness)) return false;
    return true;
  }
  Cost conflicts_at(AgentNode from, AgentNode to, std::int32_t time) {
    Cost n = 0;
    for (const auto& [other, path] : others_) {
      const AgentNode there = path->at(time);
      n += domain_.conflict(agent_, to, other, there);
      if constexpr (HasMoveConflicts<D>) n += domain_.move_conflict(agent_, from, to, other, path->at(time - 1), there);
    }
    return n;
  }
  /// Of staying for good, with what the others have still to go.
  Cost conflicts_after(const State& state) {
    Cost n = 0;
    for (const auto& [other, path] : others_)
      for (std::int32_t t = state.time + 1; t <= path->last(); ++t)
        n += domain_.conflict(agent_, state.node, other, path->at(t));
    return n;
  }

  void trace(const State& end, AgentPath& out) const {
    out.nodes.clear();
    out.cost = end.g;
    for (std::int32_t id = end.parent; id >= 0; id = states_[static_cast<std::size_t>(id)].parent)
      out.nodes.push_back(states_[static_cast<std::size_t>(id)].node);
    std::reverse(out.nodes.begin(), out.nodes.end());
  }

  D& domain_;
  Weight weight_;
  std::int64_t max_expansions_, expansions_ = 0;
  StopSource* stop_;

  int agent_ = -1;
  std::int32_t last_ = 0;
  std::vector<const Constraint*> constraints_;
  std::vector<std::pair<int, const AgentPath*>> others_;
  std::vector<State> states_;  // by number in the queue
  SpaceTimeIndex index_;
  std::vector<AgentMove> moves_;
};

}  // namespace mamo::search
