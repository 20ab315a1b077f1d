// A domain that evaluates every edge of another one once, however often it is searched, and knows what that took.
#pragma once

#include <unordered_map>
#include <vector>

#include "mamo/common/cpu_time.hpp"
#include "mamo/search/state_table.hpp"

namespace mamo::search {

/// For searches in virtual time: not thread-safe. `domain` and `context` must outlive it.
template <Domain D>
class MemoDomain {
 public:
  using State = typename D::State;
  struct Context {};

  MemoDomain(const D& domain, typename D::Context& context) : domain_(domain), context_(context), table_(domain) {}

  State start() const { return domain_.start(); }
  std::uint64_t hash(const State& s) const { return domain_.hash(s); }
  std::uint64_t class_hash(const State& s) const { return domain_.class_hash(s); }
  bool same_class(const State& a, const State& b) const { return domain_.same_class(a, b); }
  bool is_goal(const State& s) const { return domain_.is_goal(s); }
  Cost heuristic(const State& s) const { return domain_.heuristic(s); }
  void successors(Context&, const State& s, std::vector<LazyEdge>& edges) const {
    const std::size_t id = table_.intern(s).index();
    if (successors_.size() <= id) successors_.resize(id + 1);
    if (successors_[id].empty()) domain_.successors(context_, s, successors_[id]);
    edges = successors_[id];
  }
  EdgeOutcome<State> evaluate(Context&, const State& s, std::int32_t action, const std::atomic<bool>*) const {
    return evaluated(s, action).outcome;
  }

  /// CPU time of the evaluation (s).
  double seconds(const State& s, std::int32_t action) const { return evaluated(s, action).seconds; }
  /// Edges evaluated so far.
  std::size_t size() const { return edges_.size(); }

 private:
  struct Evaluated {
    EdgeOutcome<State> outcome;
    double seconds = 0;
  };
  const Evaluated& evaluated(const State& s, std::int32_t action) const {
    const auto state = static_cast<std::uint64_t>(table_.intern(s).value);
    const auto [at, fresh] = edges_.try_emplace(state << 32 | static_cast<std::uint32_t>(action));
    if (fresh) {
      const double begun = thread_cpu_s();
      at->second.outcome = domain_.evaluate(context_, s, action, nullptr);
      at->second.seconds = thread_cpu_s() - begun;
    }
    return at->second;
  }

  const D& domain_;
  typename D::Context& context_;
  mutable StateTable<D> table_;
  mutable std::vector<std::vector<LazyEdge>> successors_;          // by state
  mutable std::unordered_map<std::uint64_t, Evaluated> edges_;  // looked up, never iterated
};

}  // namespace mamo::search
