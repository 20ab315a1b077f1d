#include "interrupts.hpp"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "exit_codes.hpp"

namespace mamo::tool {
namespace {

constexpr long kGraceNs = 900'000'000;

// A signal handler can be handed nothing: what it needs lives here, set before it is installed.
std::atomic<StopSource*> g_stop{nullptr};
std::atomic<const std::string*> g_last_words{nullptr};
timer_t g_timer;

static_assert(std::atomic<StopSource*>::is_always_lock_free);

/// Everything called here is async-signal-safe.
void on_signal(int) {
  if (StopSource* stop = g_stop.load()) stop->request(StopReason::interrupted);
  const itimerspec grace{{0, 0}, {0, kGraceNs}};
  timer_settime(g_timer, 0, &grace, nullptr);
}

void on_grace_over(int) {
  const auto put = [](int descriptor, const char* text, std::size_t size) {
    while (size > 0) {
      const ssize_t written = write(descriptor, text, size);
      if (written <= 0) return;
      text += written;
      size -= static_cast<std::size_t>(written);
    }
  };
  static constexpr char kText[] = "mamo: interrupted\n";
  put(STDERR_FILENO, kText, sizeof kText - 1);
  if (const std::string* words = g_last_words.load()) put(STDOUT_FILENO, words->data(), words->size());
  _exit(kNoPlan);
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

/// Bytes resident now.
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

SignalGuard::SignalGuard(StopSource& stop) {
  g_stop = &stop;
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  timer_create(CLOCK_MONOTONIC, &event, &g_timer);
  handle(SIGALRM, on_grace_over);
  handle(SIGINT, on_signal);
  handle(SIGTERM, on_signal);
}

SignalGuard::~SignalGuard() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
  timer_delete(g_timer);
  g_stop = nullptr;
  delete g_last_words.exchange(nullptr);
}

void SignalGuard::set_last_words(std::string text) { delete g_last_words.exchange(new std::string(std::move(text))); }

MemoryGuard::MemoryGuard(StopSource& stop, std::int64_t limit_mb) {
  if (limit_mb <= 0) return;
  watcher_ = std::jthread([&stop, limit = static_cast<double>(limit_mb) * 1e6](std::stop_token token) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    while (!token.stop_requested()) {
      if (resident_bytes() > limit) return stop.request(StopReason::memory);
      wake.wait_for(lock, token, std::chrono::milliseconds(20), [] { return false; });
    }
  });
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace mamo::tool
