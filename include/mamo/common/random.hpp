// Counter-based random streams. A stream is named by what it is for (seed, vertex, object, attempt),
// so that no draw depends on what another part of the program drew before.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "mamo/common/hash.hpp"

namespace mamo {

/// Draw k of a stream is a pure function of (seed, keys, k). Copies continue independently.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::initializer_list<std::uint64_t> keys) : key_(mix64(seed)) {
    for (std::uint64_t k : keys) key_ = hash_combine(key_, k);
  }

  std::uint64_t next() { return hash_combine(key_, counter_++); }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform in {0, ..., n-1}; n > 0. The bias is below n / 2^64.
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>((static_cast<unsigned __int128>(next()) * n) >> 64);
  }
  /// Standard normal (Box-Muller, one of the pair).
  double normal() {
    const double u = 1.0 - uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace mamo
