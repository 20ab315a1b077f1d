// The closed list: a lock-free set of records, each stored once under its full key and handled by id.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "mamo/search/lock_free_index.hpp"
#include "mamo/search/segmented_arena.hpp"

namespace mamo::search {

/// LockFreeIndex over a SegmentedArena. Any number of threads may insert (each with its own Writer) and find.
/// Ids are dense up to the unused rest of the writers' blocks; they depend on the interleaving and must never reach
/// output. Nothing is erased: drop the whole list.
template <class Record>
class ClosedList {
 public:
  static constexpr std::int32_t kNone = LockFreeIndex::kNone;

  /// A thread's stock of ids. Not shared.
  class Writer {
    friend class ClosedList;
    std::int32_t next = 0, end = 0;
  };

  explicit ClosedList(std::size_t initial_slots = 1024) : index_(initial_slots) {}

  /// The record with this key, inserted if there is none; second: whether it was. equal(record) compares the full
  /// key; fill(record) writes it, and all else that readers may see, into a record that nobody else sees yet. When
  /// the race for a new key is lost, the record is filled again for a later key.
  template <class Equal, class Fill>
  std::pair<std::int32_t, bool> insert(std::uint64_t hash, Writer& writer, Equal&& equal, Fill&& fill) {
    const auto same = [&](std::int32_t id) { return equal(std::as_const(arena_)[id]); };
    std::int32_t mine = kNone;
    const std::int32_t winner = index_.insert(hash, same, [&] {
      mine = spare(writer);
      fill(arena_[mine], mine);
      return mine;
    });
    if (winner != mine) return {winner, false};
    ++writer.next;
    return {winner, true};
  }
  template <class Equal>
  std::int32_t find(std::uint64_t hash, Equal&& equal) const {
    return index_.find(hash, [&](std::int32_t id) { return equal(arena_[id]); });
  }

  Record& operator[](std::int32_t id) { return arena_[id]; }
  const Record& operator[](std::int32_t id) const { return arena_[id]; }
  /// Ids are below this.
  std::size_t id_bound() const { return arena_.size(); }
  std::size_t slots() const { return index_.slots(); }
  /// Gives up the id that insert() would use next: somebody knows it by another way than this list.
  void skip_spare(Writer& writer) { ++writer.next; }

 private:
  std::int32_t spare(Writer& writer) {
    if (writer.next == writer.end) {
      writer.next = arena_.take_block();
      writer.end = writer.next + SegmentedArena<Record>::kBlock;
      index_.reserve(static_cast<std::size_t>(arena_.size()));
    }
    return writer.next;
  }

  SegmentedArena<Record> arena_;
  LockFreeIndex index_;
};

}  // namespace mamo::search
