// Ctrl-C, SIGTERM and the memory limit, turned into a stop request.
#pragma once

#include <cstdint>
#include <string>
#include <thread>

#include "mamo/common/stop.hpp"

namespace mamo::tool {

/// While one lives, SIGINT and SIGTERM request `stop`. Should the work not end within 0.9 s of the signal, the process
/// writes the last words (if any) to standard output and ends with exit code 1. At most one at a time.
class SignalGuard {
 public:
  explicit SignalGuard(StopSource& stop);
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  /// Text for standard output should the process have to be ended from outside its work.
  void set_last_words(std::string text);
};

/// While one lives, a thread looks at the resident memory of the process every 20 ms and requests `stop` beyond the
/// limit. limit_mb == 0 starts no thread.
class MemoryGuard {
 public:
  MemoryGuard(StopSource& stop, std::int64_t limit_mb);

 private:
  std::jthread watcher_;
};

/// Megabytes (1e6 bytes): the most the process ever held.
double peak_memory_mb();

}  // namespace mamo::tool
