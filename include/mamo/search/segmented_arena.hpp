// Records that never move, in segments that double in size.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>

namespace mamo::search {

/// An append-only array that many threads may extend and read at once. Ids are handed out in blocks of kBlock, whose
/// records are default-constructed by the thread that takes the block. A record is the taker's own until it publishes
/// the id by some release operation; whoever acquired the id may read it. Lock-free: a lost race to allocate a
/// segment frees the loser's.
template <class Record>
class SegmentedArena {
 public:
  static constexpr std::int32_t kBlock = 64;
  static constexpr std::size_t kFirst = 1024;  // records of the first segment

  SegmentedArena() = default;
  ~SegmentedArena() {
    const std::size_t used = size();
    for (std::size_t i = 0; i < used; ++i) std::destroy_at(&(*this)[static_cast<std::int32_t>(i)]);
    for (auto& segment : segments_) std::allocator<Record>().deallocate(segment.load(std::memory_order_relaxed), 0);
  }
  SegmentedArena(const SegmentedArena&) = delete;
  SegmentedArena& operator=(const SegmentedArena&) = delete;

  /// The first id of a fresh block.
  std::int32_t take_block() {
    const std::size_t begin = size_.fetch_add(kBlock, std::memory_order_relaxed);
    if (begin > INT32_MAX - kBlock) throw std::length_error("too many states for 32-bit ids");
    Record* segment = ensure(segment_of(begin));
    for (std::size_t i = 0; i < kBlock; ++i) std::construct_at(segment + offset_of(begin) + i);
    return static_cast<std::int32_t>(begin);
  }
  Record& operator[](std::int32_t id) { return *at(static_cast<std::uint32_t>(id)); }
  const Record& operator[](std::int32_t id) const { return *at(static_cast<std::uint32_t>(id)); }
  /// Records in all blocks taken so far, published or not.
  std::size_t size() const { return size_.load(std::memory_order_relaxed); }

 private:
  static_assert(kFirst % kBlock == 0, "a block lies in one segment");
  // Segment k holds the indices i with kFirst << k <= i + kFirst < kFirst << (k + 1). (GCC 12 warns of std::bit_width.)
  static std::size_t segment_of(std::size_t i) {
    return static_cast<std::size_t>(__builtin_clzll(kFirst) - __builtin_clzll(i + kFirst));
  }
  static std::size_t offset_of(std::size_t i) { return i + kFirst - (kFirst << segment_of(i)); }

  Record* at(std::size_t i) const {
    // Acquire: pairs with ensure()'s release; in effect already ordered by the publication of the id.
    return segments_[segment_of(i)].load(std::memory_order_acquire) + offset_of(i);
  }
  Record* ensure(std::size_t k) {
    Record* segment = segments_[k].load(std::memory_order_acquire);
    if (segment) return segment;
    std::allocator<Record> allocator;
    Record* fresh = allocator.allocate(kFirst << k);
    if (segments_[k].compare_exchange_strong(segment, fresh, std::memory_order_acq_rel, std::memory_order_acquire)) {
      return fresh;
    }
    allocator.deallocate(fresh, kFirst << k);
    return segment;
  }

  std::atomic<std::size_t> size_{0};
  std::array<std::atomic<Record*>, 23> segments_{};  // room for any 32-bit index
};

}  // namespace mamo::search
