// When to stop: the caller's deadline, a signal, a memory limit. The only clock of the library is here.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

namespace mamo {

enum class StopReason { none = 0, timeout, interrupted, memory };

/// Shared by the caller and every worker of one query. Asked between simulation steps and between
/// expansions, at least every few milliseconds. Thread-safe. Once stopped it stays stopped.
class StopSource {
 public:
  using Clock = std::chrono::steady_clock;

  StopSource() = default;
  explicit StopSource(double time_limit_s) { set_time_limit(time_limit_s); }
  StopSource(const StopSource&) = delete;
  StopSource& operator=(const StopSource&) = delete;

  /// Seconds from now; infinity means none.
  void set_time_limit(double seconds);
  /// Safe in a signal handler (one lock-free atomic exchange).
  void request(StopReason reason) {
    int expected = 0;
    reason_.compare_exchange_strong(expected, static_cast<int>(reason), std::memory_order_relaxed);
  }
  /// True once the deadline has passed or somebody asked. Reads the clock.
  bool stopped();
  StopReason reason() const { return static_cast<StopReason>(reason_.load(std::memory_order_relaxed)); }

 private:
  std::atomic<int> reason_{0};
  std::optional<Clock::time_point> deadline_;
};

}  // namespace mamo
