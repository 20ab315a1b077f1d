#include <cmath>

#include "mamo/common/hash.hpp"
#include "mamo/common/stop.hpp"

namespace mamo {

std::string to_hex(std::uint64_t value) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) text[static_cast<std::size_t>(i)] = kDigits[value & 15];
  return text;
}

void StopSource::set_time_limit(double seconds) {
  if (!std::isfinite(seconds)) return deadline_.reset();
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool StopSource::stopped() {
  if (reason() != StopReason::none) return true;
  if (!deadline_ || Clock::now() < *deadline_) return false;
  request(StopReason::timeout);
  return true;
}

}  // namespace mamo
