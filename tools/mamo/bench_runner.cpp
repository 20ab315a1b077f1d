#include "bench_runner.hpp"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "interrupts.hpp"
#include "summary.hpp"

#include "mamo/common/stopwatch.hpp"
#include "mamo/experiments/difficulty.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"
#include "mamo/planners/validate.hpp"
#include "mamo/verify/verifier.hpp"
#include "mamo/view/playback.hpp"

namespace mamo::tool {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// Every run has a deadline and so a stop source of its own; a request on the common one reaches all within 10 ms.
class Stops {
 public:
  explicit Stops(StopSource& common)
      : watcher_([this, &common](std::stop_token token) {
          while (!token.stop_requested()) {
            if (common.stopped()) request_all(common.reason());
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          }
        }) {}

  void add(StopSource& stop) {
    const std::lock_guard lock(mutex_);
    active_.push_back(&stop);
  }
  void remove(StopSource& stop) {
    const std::lock_guard lock(mutex_);
    std::erase(active_, &stop);
  }

 private:
  void request_all(StopReason reason) {
    const std::lock_guard lock(mutex_);
    for (StopSource* stop : active_) stop->request(reason);
  }

  std::mutex mutex_;
  std::vector<StopSource*> active_;
  std::jthread watcher_;  // last: it uses the others
};

/// The problem a worker holds: the runs of one problem follow one another.
struct HeldProblem {
  std::size_t source = 0;
  int index = -1;
  Result<Problem> problem = Error{};
  std::string difficulty;  // of a retrieval
  double load_s = 0;
};

const Result<Problem>& hold(HeldProblem& held, const Suite& suite, const BenchRun& run) {
  if (held.index != run.problem || held.source != run.source) {
    const Stopwatch watch;
    held.problem = problem_of(suite, run);
    if (held.problem.ok())
      if (const Status status = validate(*held.problem); !status.ok()) held.problem = status.error();
    held.source = run.source;
    held.index = run.problem;
    held.load_s = watch.seconds();
    held.difficulty.clear();
    if (held.problem.ok())
      if (const auto difficulty = mamo::difficulty(*held.problem)) held.difficulty = to_string(*difficulty);
  }
  return held.problem;
}

PlanResult no_result(const PlannerEntry& planner, const BenchRun& run, int threads, const std::string& reason) {
  PlanResult result;
  result.status = PlanStatus::invalid;
  result.reason = reason;
  result.planner = planner.name;
  result.seed = run.seed;
  result.threads = threads;
  return result;
}

PlanResult plan(const PlannerEntry& entry, const BenchRun& run, const Problem& problem, int threads, Stops& stops,
                bool& interrupted) {
  const auto planner = make_planner(entry.name);
  if (!planner->can_solve(problem.task)) return no_result(entry, run, threads, "the planner cannot do this task");
  PlanOptions options;
  options.seed = run.seed;
  options.threads = threads;
  options.weight = entry.weight;
  options.max_simulations = entry.limits.max_simulations;
  options.max_expansions = entry.limits.max_expansions;
  options.set = entry.set;
  const Verifier judge;
  const Stopwatch watch;
  StopSource stop(entry.limits.time_s);
  stops.add(stop);
  PlanResult result;
  try {
    result = planner->plan(problem, options, {&stop, &judge, {}});
  } catch (...) {
    stops.remove(stop);
    throw;
  }
  stops.remove(stop);
  interrupted = result.status == PlanStatus::interrupted;
  if (result.status == PlanStatus::solved && !result.verified) {
    result.status = PlanStatus::error;
    result.reason = "the planner returned a plan that was not verified";
  }
  if (result.status != PlanStatus::error && result.status != PlanStatus::invalid)
    result.reason = why_no_plan(result, options, entry.limits.time_s, 0);
  result.stats.wall_s = watch.seconds();
  return result;
}

/// The plan is verified once more for its recording; the run's own times are taken before.
Status write_page(const std::string& folder, const BenchRun& run, const Problem& problem, const PlanResult& result) {
  StopSource stop;
  Recording recording;
  Verdict verdict;
  const bool planned = !result.plan.empty();
  if (planned) verdict = Verifier().judge(problem, result.plan, stop, recording);
  const view::Playback shown{&problem, &result, planned ? &recording : nullptr, planned ? &verdict : nullptr};
  return io::write_file((std::filesystem::path(folder) / page_file_name(run.id)).string(), view::playback_page(shown));
}

}  // namespace

Status run_all(const Suite& suite, const std::vector<BenchRun>& runs, const BenchOptions& options,
               const RunMachine& machine, StopSource& stop, const std::function<Status(const FinishedRun&)>& finished) {
  Stops stops(stop);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // of `finished` and `failure`
  std::optional<Error> failure;
  const auto give_up = [&](Error error) {
    if (!failure) failure = std::move(error);
    stop.request(StopReason::interrupted);
  };

  const auto one = [&](const BenchRun& run, HeldProblem& held) {
    const PlannerEntry& entry = suite.planners[run.planner];
    const std::string started = utc_now();
    const Result<Problem>& problem = hold(held, suite, run);
    const int threads = entry.threads > 0 ? entry.threads : options.threads;
    bool interrupted = false;
    FinishedRun done{&run, {}, {}};
    Problem unread;
    unread.name = unread.path = suite.problems[run.source].generated()
                                    ? run.id
                                    : suite.problems[run.source].files[static_cast<std::size_t>(run.problem)];
    done.result = problem.ok() ? plan(entry, run, *problem, threads, stops, interrupted)
                               : no_result(entry, run, threads, problem.error().message);
    if (interrupted) return;
    done.result.stats.load_s = held.load_s;
    done.result.stats.wall_s += held.load_s;
    done.result.stats.peak_memory_mb = peak_memory_mb();
    done.line = bench_line(suite, run, done.result, problem.ok() ? *problem : unread, machine, started,
                           options.keep_plans, held.difficulty);
    Status page;
    if (!options.pages.empty() && problem.ok()) page = write_page(options.pages, run, *problem, done.result);
    const std::lock_guard lock(mutex);
    if (failure) return;
    if (!page.ok()) return give_up(page.error());
    if (const Status status = finished(done); !status.ok()) give_up(status.error());
  };

  const auto work = [&] {
    HeldProblem held;
    for (std::size_t k; !stop.stopped() && (k = next++) < runs.size();) {
      try {
        one(runs[k], held);
      } catch (const std::invalid_argument& error) {  // a planner-specific option out of range
        const std::lock_guard lock(mutex);
        give_up({error.what(), ErrorKind::usage});
      } catch (const std::exception& error) {
        const std::lock_guard lock(mutex);
        give_up({runs[k].id + ": " + error.what(), ErrorKind::internal});
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < std::min<int>(options.jobs, static_cast<int>(runs.size())); ++i) others.emplace_back(work);
    work();
  }
  return failure ? Status(*failure) : Status();
}

}  // namespace mamo::tool
