// A recorded search as a domain: what was evaluated then can be searched again, in virtual time.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mamo/search/domain.hpp"
#include "mamo/search/trace.hpp"

namespace mamo::search {

/// States are the ids of the trace. Edges that the recorded run did not evaluate count as invalid, and take as long as
/// one that it did evaluate, drawn by a hash of the edge: only speculation meets them (what the order commits has
/// been evaluated), so they model waste. The more threads the recorded run had, the fewer there are.
class TraceDomain {
 public:
  struct State {
    std::int32_t id = -1;
    friend bool operator==(const State&, const State&) = default;
  };
  struct Context {};

  /// The trace must outlive this.
  explicit TraceDomain(const Trace& trace);

  State start() const { return {trace_.start}; }
  std::uint64_t hash(const State& s) const { return static_cast<std::uint64_t>(s.id); }
  std::uint64_t class_hash(const State& s) const { return static_cast<std::uint64_t>(class_of(s)); }
  bool same_class(const State& a, const State& b) const { return class_of(a) == class_of(b); }
  bool is_goal(const State& s) const;
  Cost heuristic(const State& s) const;
  void successors(Context&, const State& s, std::vector<LazyEdge>& edges) const;
  EdgeOutcome<State> evaluate(Context&, const State& s, std::int32_t action, const std::atomic<bool>*) const;
  bool known_child(const State& s, std::int32_t action, State& child) const;

  /// Length of an evaluation (s, thread CPU time of the recorded run).
  double seconds(const State& s, std::int32_t action) const;
  /// The limit that ends the repeated search where the recorded one ended, if that found no goal.
  std::int64_t commits() const { return commits_; }
  /// Whether the recorded run evaluated this edge.
  bool recorded(const State& s, std::int32_t action) const { return job(s, action) != nullptr; }

 private:
  static std::uint64_t key(std::int32_t state, std::int32_t edge) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(state)) << 32 | static_cast<std::uint32_t>(edge);
  }
  const TraceState* record(const State& s) const;
  const TraceJob* job(const State& s, std::int32_t action) const;
  std::int32_t class_of(const State& s) const;

  const Trace& trace_;
  std::unordered_map<std::int32_t, std::size_t> states_;  // looked up, never iterated
  std::unordered_map<std::uint64_t, std::size_t> jobs_;   // finished ones
  std::vector<std::size_t> finished_;
  std::int64_t commits_ = 0;
};

}  // namespace mamo::search
