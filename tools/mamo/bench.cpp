// mamo bench: the runs of a suite, one line of JSON for each.
#include <algorithm>
#include <filesystem>
#include <thread>

#include "bench_runner.hpp"
#include "checks.hpp"
#include "exit_codes.hpp"
#include "interrupts.hpp"
#include "machine.hpp"
#include "output_files.hpp"
#include "session.hpp"

#include "mamo/common/stopwatch.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"

namespace mamo::tool {
namespace {

struct BenchCommand {
  std::string suite, problems, out, shard;
  std::vector<std::string> planners;
  BenchOptions options;
  double time_limit_s = 120;
  int threads = 0;
  bool resume = false, no_plans = false;
};

/// "2/5" -> {2, 5}; nothing unless 1 <= I <= N.
std::optional<std::pair<int, int>> parse_shard(const std::string& text) {
  int i = 0, n = 0, read = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &i, &n, &read) != 2 || read != static_cast<int>(text.size())) return {};
  if (i < 1 || i > n) return {};
  return std::pair(i, n);
}

std::string check_shard(const std::string& text) {
  return parse_shard(text) ? "" : "expected I/N with 1 <= I <= N, not '" + text + "'";
}

Result<Suite> suite_of(const BenchCommand& command, bool time_limit_given) {
  if (!command.suite.empty()) {
    if (!command.planners.empty()) return Error{"--planners goes with --problems, without a suite", ErrorKind::usage};
    auto suite = read_suite(command.suite);
    if (!suite.ok()) return suite;
    if (time_limit_given)
      for (PlannerEntry& planner : suite->planners) planner.limits.time_s = command.time_limit_s;
    if (command.problems.empty()) return suite;
    auto source = file_source(command.problems, "");
    if (!source.ok()) return source.error();
    suite->problems = {std::move(*source)};
    return suite;
  }
  if (command.problems.empty())
    return Error{"give either a suite or --problems GLOB with --planners A,B", ErrorKind::usage};
  if (command.planners.empty()) return Error{"--problems and --planners go together", ErrorKind::usage};
  Suite suite;
  suite.name = "problems";
  auto source = file_source(command.problems, "");
  if (!source.ok()) return source.error();
  suite.problems.push_back(std::move(*source));
  for (const std::string& name : command.planners) {
    PlannerEntry entry;
    entry.name = entry.label = name;
    entry.limits.time_s = command.time_limit_s;
    if (std::any_of(suite.planners.begin(), suite.planners.end(), [&](const auto& p) { return p.name == name; }))
      return Error{"--planners names '" + name + "' twice", ErrorKind::usage};
    suite.planners.push_back(std::move(entry));
  }
  return suite;
}

/// What this process has to run: its shard, without what the file holds.
Result<std::vector<BenchRun>> runs_left(const Suite& suite, const BenchCommand& command, const RecordFile& file) {
  const auto [shard, shards] = parse_shard(command.shard.empty() ? "1/1" : command.shard).value();
  std::vector<BenchRun> left;
  for (BenchRun& run : runs_of(suite)) {
    if (run.index % shards != shard - 1) continue;
    const Result<bool> done = file.done(run);
    if (!done.ok()) return done.error();
    if (!*done) left.push_back(std::move(run));
  }
  return left;
}

std::string duration(double seconds) {
  const long s = static_cast<long>(seconds + 0.5);
  if (s < 100) return format("%ld s", s);
  return s < 6000 ? format("%ld min", (s + 30) / 60) : format("%.1f h", seconds / 3600);
}

int run(const CLI::App& app, BenchCommand& command, Console& console) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.options.threads = command.threads > 0 ? command.threads : std::max(1, cores / command.options.jobs);
  command.options.keep_plans = !command.no_plans;
  if (command.resume && command.out.empty())
    return fail(console, {"--resume goes on with a results file: name it with --out", ErrorKind::usage});
  const Result<Suite> suite = suite_of(command, app.get_option("--time-limit")->count() > 0);
  if (!suite.ok()) return fail(console, suite.error());
  RecordFile file;
  if (!command.out.empty()) {
    if (const Status status = check_outputs({command.out}, {command.suite}); !status.ok())
      return fail(console, status.error());
    if (const Status status = file.open(command.out, command.resume); !status.ok())
      return fail(console, status.error());
  }
  if (!command.options.pages.empty()) {
    std::error_code none;
    std::filesystem::create_directories(command.options.pages, none);
    const std::string probe = (std::filesystem::path(command.options.pages) / "page.html").string();
    if (const Status status = io::check_writable(probe); !status.ok()) return fail(console, status.error());
  }
  const auto runs = runs_left(*suite, command, file);
  if (!runs.ok()) return fail(console, runs.error());
  const RunMachine machine{machine_json(), source_commit()};
  for (const std::string& commit : file.commits())
    if (commit != machine.commit) console.warn(command.out + " holds runs of another commit: " + commit);

  StopSource stop;
  const SignalGuard signals(stop);
  const Stopwatch watch;
  std::size_t finished = 0, solved = 0, internal = 0;
  const Status status = run_all(*suite, *runs, command.options, machine, stop, [&](const FinishedRun& done) -> Status {
    if (command.out.empty()) {
      std::printf("%s\n", done.line.c_str());
      if (std::fflush(stdout) != 0) return Error{"standard output cannot be written", ErrorKind::output};
    } else if (const Status written = file.append(done.line); !written.ok()) {
      return written;
    }
    ++finished;
    solved += done.result.status == PlanStatus::solved;
    internal += done.result.status == PlanStatus::error;
    if (done.result.status == PlanStatus::error) console.warn(done.run->id + ": " + done.result.reason);
    const double left = watch.seconds() / static_cast<double>(finished) * static_cast<double>(runs->size() - finished);
    console.progress(format("%zu of %zu runs, %zu solved, about %s left: %s", finished, runs->size(), solved,
                            duration(left).c_str(), done.run->id.c_str()));
    return {};
  });
  console.end_progress();
  if (!status.ok()) return fail(console, status.error());
  if (!command.out.empty())
    std::printf("%zu of %zu runs finished, %zu solved, in %s: %s\n", finished, runs->size(), solved,
                duration(watch.seconds()).c_str(), command.out.c_str());
  if (stop.stopped()) {
    console.error("mamo: interrupted" + std::string(command.out.empty() ? "" : "; --resume goes on"));
    return kNoPlan;
  }
  if (internal > 0)
    return fail(console, {format("%zu runs ended in an internal error", internal), ErrorKind::internal});
  return kSolved;
}

}  // namespace

void add_bench(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("bench", "Run a suite of experiments, one line of JSON for each run");
  auto command = std::make_shared<BenchCommand>();
  sub->add_option("suite", command->suite, "Suite file (mamo-suite/1)")->type_name("SUITE")->check(file_name());
  sub->add_option("--problems", command->problems,
                  "Instead of the suite's problems: a glob of problem files, or @LIST, a file that lists them")
      ->type_name("GLOB")
      ->check(file_name());
  sub->add_option("--planners", command->planners, "Without a suite: planners, separated by commas")
      ->type_name("A,B")
      ->delimiter(',')
      ->check(one_of(planner_names()));
  sub->add_option("--time-limit", command->time_limit_s, "Seconds for a run (of a suite: instead of its own)")
      ->type_name("SEC")
      ->check(number_above(0))
      ->capture_default_str();
  sub->add_option("--out", command->out, "Append the lines here; without it they go to standard output")
      ->type_name("FILE")
      ->check(file_name());
  sub->add_option("--jobs", command->options.jobs, "Runs side by side")
      ->type_name("J")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  sub->add_option("--threads", command->threads, "Inside one run (default: cores / jobs)")
      ->type_name("N")
      ->check(whole_number(1, 4096));
  sub->add_flag("--resume", command->resume, "Go on with the file of --out: only runs that it does not hold");
  sub->add_option("--shard", command->shard, "Only every N-th problem, from the I-th: parts for several machines")
      ->type_name("I/N")
      ->check(check_shard);
  sub->add_option("--pages", command->options.pages,
                  "Folder for a playback page of every run; mamo report links to them")
      ->type_name("DIR")
      ->check(file_name());
  sub->add_flag("--no-plans", command->no_plans, "Leave the plans out of the lines");
  add_console_options(*sub, session);
  sub->footer(
      "Example:\n  mamo bench bench/suites/selsim_table1.yaml --out table1.jsonl --resume\n"
      "  mamo report table1.jsonl --out report");
  sub->callback([sub, command, &session] {
    session.run = [sub, command, &session] { return run(*sub, *command, session.console); };
  });
}

}  // namespace mamo::tool
