// Every state of a search, stored once and handled by id; which classes are closed.
#pragma once

#include <atomic>
#include <cstdint>

#include "mamo/common/ids.hpp"
#include "mamo/search/closed_list.hpp"
#include "mamo/search/domain.hpp"

namespace mamo::search {

inline constexpr StateId kNoState{-1};

/// Interns states by their exact key and keeps, per class, which state closed it. Full keys are compared; a hash
/// only finds the slot. Lock-free: any thread may intern (with its own Writer) and look up at any time.
///
/// close() is for one thread at a time, the one that commits; a look-up of closed_by() on another thread is a hint:
/// "closed" is true for good, "open" may be over. A class is represented by one of its members, the first that came;
/// which one that is depends on the interleaving and shows nowhere.
template <Domain D>
class StateTable {
 public:
  using State = typename D::State;

  struct Record {
    State state{};
    std::uint64_t hash = 0, class_hash = 0;
    std::int32_t class_of = -1;               // the member that represents the class
    std::atomic<std::int32_t> closed_by{-1};  // kept at the representative
    std::atomic<bool> expanded{false};
  };
  using Writer = typename ClosedList<Record>::Writer;

  explicit StateTable(const D& domain) : domain_(domain) {}

  /// The id of `state`, new or old.
  StateId intern(const State& state, Writer& writer) {
    const std::uint64_t hash = domain_.hash(state);
    bool represents = false;
    const auto equal = [&](const Record& r) { return r.hash == hash && r.state == state; };
    const auto fill = [&](Record& r, std::int32_t id) {
      r.state = state;
      r.hash = hash;
      r.class_hash = domain_.class_hash(state);
      r.class_of = class_of(r, id);
      represents = r.class_of == id;
    };
    const auto [id, fresh] = states_.insert(hash, writer, equal, fill);
    // The race for the exact key was lost, but the record has become known as representative of its class: it stays.
    if (!fresh && represents) states_.skip_spare(writer);
    return StateId(id);
  }
  /// The same for the thread that commits.
  StateId intern(const State& state) { return intern(state, writer_); }
  /// The id of `state`, or kNoState.
  StateId find(const State& state) const {
    const std::uint64_t hash = domain_.hash(state);
    return StateId(states_.find(hash, [&](const Record& r) { return r.hash == hash && r.state == state; }));
  }

  const State& state(StateId id) const { return states_[id.value].state; }
  std::uint64_t hash(StateId id) const { return states_[id.value].hash; }
  /// The state that represents the class of `id`.
  StateId class_of(StateId id) const { return StateId(states_[id.value].class_of); }

  /// The state that closed the class of `id`, or kNoState. Acquire pairs with close(): the closer may be read.
  StateId closed_by(StateId id) const {
    return StateId(states_[states_[id.value].class_of].closed_by.load(std::memory_order_acquire));
  }
  /// The same for a state that need not be in the table.
  StateId closed_by(const State& state) const {
    const std::uint64_t hash = domain_.class_hash(state);
    const std::int32_t id = classes_.find(hash, [&](std::int32_t other) { return same_class(other, hash, state); });
    return id < 0 ? kNoState : StateId(states_[id].closed_by.load(std::memory_order_acquire));
  }
  void close(StateId id) { states_[states_[id.value].class_of].closed_by.store(id.value, std::memory_order_release); }
  /// A note of the scheduler to workers, who need not generate the successors of such a state again. A hint, no more:
  /// relaxed, and nothing is read on the strength of it.
  void set_expanded(StateId id) { states_[id.value].expanded.store(true, std::memory_order_relaxed); }
  bool expanded(StateId id) const { return states_[id.value].expanded.load(std::memory_order_relaxed); }
  /// Ids are below this.
  std::size_t id_bound() const { return states_.id_bound(); }

 private:
  bool same_class(std::int32_t id, std::uint64_t class_hash, const State& state) const {
    const Record& r = states_[id];
    return r.class_hash == class_hash && domain_.same_class(r.state, state);
  }
  std::int32_t class_of(const Record& record, std::int32_t id) {
    classes_.reserve(states_.id_bound());
    return classes_.insert(
        record.class_hash, [&](std::int32_t other) { return same_class(other, record.class_hash, record.state); },
        [id] { return id; });
  }

  const D& domain_;
  ClosedList<Record> states_;
  LockFreeIndex classes_;  // one entry per class: its representative
  Writer writer_;
};

}  // namespace mamo::search
