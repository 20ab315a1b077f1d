#include "mamo/common/executor.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>
#include <vector>

#if defined(__SANITIZE_THREAD__)
#include <thread>
#else
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace mamo {
namespace {

/// Runs the body and keeps what it throws in its own slot.
void guarded(const std::function<void(WorkerId)>& body, int worker, std::vector<std::exception_ptr>& errors) {
  try {
    body(WorkerId(worker));
  } catch (...) {
    errors[static_cast<std::size_t>(worker)] = std::current_exception();
  }
}

}  // namespace

#if defined(__SANITIZE_THREAD__)

struct Executor::Impl {
  explicit Impl(int) {}
  void run(int workers, const std::function<void(int)>& body) {
    std::vector<std::jthread> threads;
    for (int w = 1; w < workers; ++w) threads.emplace_back([&body, w] { body(w); });
    body(0);
  }
};

#else

struct Executor::Impl {
  explicit Impl(int workers) : arena(workers, 1) {
    // More workers than cores are allowed, but oneTBB's default limit is the number of cores. Not set otherwise:
    // among several controls the smallest wins, and other executors may be alive.
    if (workers > tbb::info::default_concurrency()) {
      control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(workers));
    }
  }
  void run(int workers, const std::function<void(int)>& body) {
    arena.execute([&] {
      tbb::task_group group;
      for (int w = 1; w < workers; ++w) group.run([&body, w] { body(w); });
      body(0);
      group.wait();
    });
  }
  std::optional<tbb::global_control> control;
  tbb::task_arena arena;
};

#endif

Executor::Executor(int workers) : workers_(workers) {
  if (workers < 1) throw std::invalid_argument("an executor needs at least one worker");
  if (workers > 1) impl_ = std::make_unique<Impl>(workers);
}

Executor::~Executor() = default;

void Executor::run(const std::function<void(WorkerId)>& body) {
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(workers_));
  if (workers_ == 1) {
    guarded(body, 0, errors);
  } else {
    impl_->run(workers_, [&](int w) { guarded(body, w, errors); });
  }
  const auto first = std::find_if(errors.begin(), errors.end(), [](const auto& e) { return e != nullptr; });
  if (first != errors.end()) std::rethrow_exception(*first);
}

}  // namespace mamo
