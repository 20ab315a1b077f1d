#include "mamo/common/job_board.hpp"

namespace mamo {

JobBoard::Handle JobBoard::post(int urgency, Work work) {
  auto job = std::make_shared<Job>();
  job->work = std::move(work);
  {
    const std::scoped_lock lock(mutex_);
    job->rank = {urgency, posted_++};
    pending_.emplace(job->rank, job);
  }
  changed_.notify_one();
  return job;
}

JobBoard::Handle JobBoard::take() {
  if (pending_.empty()) return nullptr;
  Handle job = pending_.begin()->second;
  pending_.erase(pending_.begin());
  job->phase = Job::Phase::running;
  running_.emplace(job->rank, job);
  return job;
}

void JobBoard::perform(const Handle& job, WorkerId worker) {
  try {
    job->work(worker, job->cancelled);
  } catch (...) {
    job->error = std::current_exception();
  }
  {
    const std::scoped_lock lock(mutex_);
    job->phase = Job::Phase::done;
    job->work = nullptr;
    running_.erase(job->rank);
  }
  changed_.notify_all();
}

void JobBoard::finish(const Handle& job) {
  std::unique_lock lock(mutex_);
  if (job->phase == Job::Phase::pending) {
    pending_.erase(job->rank);
    job->phase = Job::Phase::running;
    running_.emplace(job->rank, job);
    lock.unlock();
    perform(job, WorkerId(0));
    lock.lock();
  }
  while (job->phase != Job::Phase::done) {
    if (const Handle other = take()) {
      lock.unlock();
      perform(other, WorkerId(0));
      lock.lock();
    } else {
      changed_.wait(lock);
    }
  }
  if (job->error) std::rethrow_exception(job->error);
}

void JobBoard::drop(const Handle& job) {
  if (!job) return;
  const std::scoped_lock lock(mutex_);
  job->cancelled.store(true, std::memory_order_relaxed);
  if (job->phase != Job::Phase::pending) return;
  pending_.erase(job->rank);
  job->phase = Job::Phase::done;
  job->work = nullptr;
}

void JobBoard::work(WorkerId worker) {
  std::unique_lock lock(mutex_);
  while (!over_) {
    if (const Handle job = take()) {
      lock.unlock();
      perform(job, worker);
      lock.lock();
    } else {
      changed_.wait(lock);
    }
  }
}

void JobBoard::run(Executor& executor, JobBoard& board, const std::function<void()>& serial) {
  executor.run([&](WorkerId worker) {
    if (worker.value != 0) return board.work(worker);
    std::exception_ptr error;
    try {
      serial();
    } catch (...) {
      error = std::current_exception();
    }
    {
      const std::scoped_lock lock(board.mutex_);
      board.over_ = true;
      board.pending_.clear();
      for (const auto& [rank, job] : board.running_) job->cancelled.store(true, std::memory_order_relaxed);
    }
    board.changed_.notify_all();
    if (error) std::rethrow_exception(error);
  });
}

}  // namespace mamo
