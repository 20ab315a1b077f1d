// Starts workers. The only place of the library that does.
#pragma once

#include <functional>
#include <memory>

#include "mamo/common/ids.hpp"

namespace mamo {

/// A set of workers that outlives single searches. oneTBB in production; std::jthread in the ThreadSanitizer build,
/// because Debian's oneTBB is not instrumented. Constructing one starts no thread; run() with one worker never does.
class Executor {
 public:
  explicit Executor(int workers);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int workers() const { return workers_; }

  /// Calls body(w) once for every worker w = 0 .. workers-1 and returns when all have returned; the caller's thread
  /// is worker 0. Bodies may block on one another's progress only if one of them alone could do all the work:
  /// oneTBB may start the others late, or run several of them one after the other.
  /// If bodies throw, the exception of the smallest w is rethrown, after all have returned.
  void run(const std::function<void(WorkerId)>& body);

 private:
  struct Impl;
  int workers_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mamo
