// 64-bit mixing and streaming hashes. A hash finds a slot or names a result; it is never identity.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace mamo {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64 bits.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Order-dependent combination of a running hash with the next word.
constexpr std::uint64_t hash_combine(std::uint64_t seed, std::uint64_t word) {
  return mix64(seed ^ (mix64(word) + 0x9e3779b97f4a7c15ull + (seed << 6) + (seed >> 2)));
}

/// Accumulates words, doubles (by their bits) and strings into one 64-bit value.
class HashStream {
 public:
  void add(std::uint64_t word) { value_ = hash_combine(value_, word); }
  void add(std::int64_t word) { add(static_cast<std::uint64_t>(word)); }
  void add(std::int32_t word) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(word))); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    std::uint64_t word = 0;
    int filled = 0;
    for (char c : text) {
      word = word << 8 | static_cast<unsigned char>(c);
      if (++filled == 8) add(word), word = 0, filled = 0;
    }
    if (filled) add(word);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x6d616d6f;  // "mamo"
};

/// 16 lower-case hexadecimal digits.
std::string to_hex(std::uint64_t value);

}  // namespace mamo
