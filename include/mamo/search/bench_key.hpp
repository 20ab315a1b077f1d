// How urgent an evaluation is that the serial order has not asked for yet.
#pragma once

#include <array>
#include <compare>
#include <limits>

#include "mamo/search/domain.hpp"

namespace mamo::search {

/// The f that OPEN must rise to, one after the other, before the serial order comes to an edge: along the edges that
/// lead there from what is committed, the largest f, then the largest after that one, and so on: strictly falling.
/// Of two edges the one with the lexicographically smaller sequence comes first, whatever the f of what both share.
/// Only the first kDepth are kept; padded with kNow, which is less than any f.
struct Bench {
  static constexpr std::size_t kDepth = 4;
  static constexpr Cost kNow = std::numeric_limits<Cost>::min();

  std::array<Cost, kDepth> maxima;
  static Bench now() { return Bench{}.fill(kNow); }
  static Bench never() { return Bench{}.fill(std::numeric_limits<Cost>::max()); }
  /// One edge further on.
  Bench after(Cost f) const {
    Bench next = *this;
    std::size_t i = 0;
    while (i < kDepth && next.maxima[i] > f) ++i;
    if (i < kDepth) next.maxima[i] = f;
    for (++i; i < kDepth; ++i) next.maxima[i] = kNow;
    return next;
  }
  friend auto operator<=>(const Bench&, const Bench&) = default;

 private:
  Bench& fill(Cost value) {
    maxima.fill(value);
    return *this;
  }
};

/// Urgency of an evaluation: when the serial order could ask for it at the earliest.
struct BenchKey {
  Bench bench;
  Cost f = 0, g = 0;
  friend bool operator<(const BenchKey& a, const BenchKey& b) {
    if (const auto order = a.bench <=> b.bench; order != 0) return order < 0;
    if (a.f != b.f) return a.f < b.f;
    return a.g > b.g;
  }
};

}  // namespace mamo::search
