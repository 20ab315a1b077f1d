// Pure jobs computed ahead by idle workers, while one thread commits their results in an order of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "mamo/common/executor.hpp"

namespace mamo {

/// The serial algorithm runs on the caller's thread as if alone: it posts what it may need, and asks for a result when
/// it does need it. What a job computes must be a pure function of what was posted, so that it does not matter who
/// ran it, when, or whether it was run at all. Nobody waits while something can be computed.
class JobBoard {
 public:
  /// The work: `worker` is who runs it (0: the caller's thread), `cancelled` turns true once nobody wants the result.
  using Work = std::function<void(WorkerId worker, const std::atomic<bool>& cancelled)>;

  class Job {
   private:
    friend class JobBoard;
    Work work;
    std::pair<int, long> rank;
    enum class Phase { pending, running, done } phase = Phase::pending;
    std::atomic<bool> cancelled{false};
    std::exception_ptr error;
  };
  using Handle = std::shared_ptr<Job>;

  /// Runs `serial` on this thread with the executor's other workers taking jobs until it returns or throws.
  static void run(Executor& executor, JobBoard& board, const std::function<void()>& serial);

  /// Smaller `urgency` first, then in order of posting. From any thread, jobs included.
  Handle post(int urgency, Work work);
  /// Returns when the job is done: runs it here if nobody has begun, else runs others while it waits. Rethrows what
  /// the job threw. Serial thread only; not for a job that was dropped.
  void finish(const Handle& job);
  /// Nobody wants it any more: forgotten if pending, told to stop if running. Null and done jobs are ignored.
  void drop(const Handle& job);

 private:
  Handle take();
  void perform(const Handle& job, WorkerId worker);
  void work(WorkerId worker);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::pair<int, long>, Handle> pending_;
  std::map<std::pair<int, long>, Handle> running_;
  long posted_ = 0;
  bool over_ = false;
};

}  // namespace mamo
