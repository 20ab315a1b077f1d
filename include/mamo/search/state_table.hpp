// Every state of a search, stored once and handled by id; which classes are closed.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "mamo/common/ids.hpp"
#include "mamo/search/domain.hpp"

namespace mamo::search {

inline constexpr StateId kNoState{-1};

/// Interns states by their exact key and keeps, per class, which state closed it. Full keys are compared; a hash
/// only finds the slot. Serial.
template <Domain D>
class StateTable {
 public:
  using State = typename D::State;

  explicit StateTable(const D& domain) : domain_(domain), exact_(kInitialSlots, -1), classes_(kInitialSlots, -1) {}

  /// The id of `state`, new or old.
  StateId intern(const State& state) {
    const std::uint64_t hash = domain_.hash(state);
    std::size_t slot = probe(exact_, hash, [&](const Record& r) { return r.hash == hash && r.state == state; });
    if (exact_[slot] >= 0) return StateId(exact_[slot]);
    if (2 * (records_.size() + 1) > exact_.size()) {
      grow();
      slot = probe(exact_, hash, [](const Record&) { return false; });
    }
    const auto id = static_cast<std::int32_t>(records_.size());
    const std::uint64_t class_hash = domain_.class_hash(state);
    const std::size_t class_slot = probe(classes_, class_hash, [&](const Record& r) {
      return r.class_hash == class_hash && domain_.same_class(r.state, state);
    });
    if (classes_[class_slot] < 0) classes_[class_slot] = id;
    exact_[slot] = id;
    records_.push_back({state, hash, class_hash, classes_[class_slot], -1});
    return StateId(id);
  }

  const State& state(StateId id) const { return records_[id.index()].state; }
  std::uint64_t hash(StateId id) const { return records_[id.index()].hash; }
  /// The state that closed the class of `id`, or kNoState.
  StateId closed_by(StateId id) const { return StateId(representative(id).closed_by); }
  /// The same for a state that need not be in the table.
  StateId closed_by(const State& state) const {
    const std::uint64_t class_hash = domain_.class_hash(state);
    const std::size_t slot = probe(classes_, class_hash, [&](const Record& r) {
      return r.class_hash == class_hash && domain_.same_class(r.state, state);
    });
    return classes_[slot] < 0 ? kNoState : StateId(records_[static_cast<std::size_t>(classes_[slot])].closed_by);
  }
  void close(StateId id) { records_[static_cast<std::size_t>(records_[id.index()].class_of)].closed_by = id.value; }
  std::size_t size() const { return records_.size(); }

 private:
  struct Record {
    State state;
    std::uint64_t hash, class_hash;
    std::int32_t class_of;   // first member seen
    std::int32_t closed_by;  // of the class; kept at its first member
  };
  static constexpr std::size_t kInitialSlots = 1024;

  const Record& representative(StateId id) const {
    return records_[static_cast<std::size_t>(records_[id.index()].class_of)];
  }
  /// The slot that holds a matching record, or the empty one where it would go.
  template <class Match>
  std::size_t probe(const std::vector<std::int32_t>& slots, std::uint64_t hash, Match match) const {
    std::size_t slot = hash & (slots.size() - 1);
    while (slots[slot] >= 0 && !match(records_[static_cast<std::size_t>(slots[slot])])) {
      slot = (slot + 1) & (slots.size() - 1);
    }
    return slot;
  }
  void grow() {
    const std::size_t size = 2 * exact_.size();
    exact_.assign(size, -1);
    classes_.assign(size, -1);
    const auto none = [](const Record&) { return false; };
    for (std::size_t i = 0; i < records_.size(); ++i) {
      const auto id = static_cast<std::int32_t>(i);
      exact_[probe(exact_, records_[i].hash, none)] = id;
      if (records_[i].class_of == id) classes_[probe(classes_, records_[i].class_hash, none)] = id;
    }
  }

  const D& domain_;
  std::deque<Record> records_;  // never moves, so references to states stay good
  std::vector<std::int32_t> exact_, classes_;
};

}  // namespace mamo::search
