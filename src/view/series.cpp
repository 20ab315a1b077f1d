#include "view/series.hpp"

#include <cmath>

namespace mamo::view {
namespace {

void put(std::vector<std::uint8_t>& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value) | 0x80);
  out.push_back(static_cast<std::uint8_t>(value));
}

/// 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
std::uint64_t zigzag(std::int64_t v) {
  return (static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63);
}

}  // namespace

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? bytes[i + k] : std::uint8_t{0}; };
    const std::uint32_t word = (std::uint32_t{byte(0)} << 16) | (std::uint32_t{byte(1)} << 8) | byte(2);
    for (std::size_t k = 0; k < 4; ++k) out += k <= bytes.size() - i ? kDigits[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

nlohmann::json series(const std::vector<double>& values, double unit) {
  std::vector<std::uint8_t> bytes;
  std::int64_t last = 0;
  std::uint64_t zeros = 0;
  const auto flush = [&] {
    if (zeros > 0) put(bytes, 0), put(bytes, zeros - 1);
    zeros = 0;
  };
  for (double value : values) {
    const std::int64_t now = std::isfinite(value) ? std::llround(value / unit) : last;
    if (now == last) {
      ++zeros;
    } else {
      flush();
      put(bytes, zigzag(now - last));
    }
    last = now;
  }
  flush();
  return {{"n", values.size()}, {"u", unit}, {"d", base64(bytes)}};
}

}  // namespace mamo::view
