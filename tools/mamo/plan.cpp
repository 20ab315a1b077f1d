// mamo plan: problem in, verified plan out.
#include <chrono>

#include "checks.hpp"
#include "exit_codes.hpp"
#include "file_options.hpp"
#include "interrupts.hpp"
#include "output_files.hpp"
#include "planning_options.hpp"
#include "session.hpp"
#include "summary.hpp"

#include "mamo/io/result_json.hpp"
#include "mamo/planners/registry.hpp"
#include "mamo/planners/validate.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo::tool {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct PlanCommand {
  FileOptions files;
  PlanningOptions planning;
  std::string out;
  bool json = false;
};

/// At most ten lines a second, on terminals only.
std::function<void(const Progress&)> progress_printer(Console& console) {
  if (!console.shows_progress()) return {};
  return [&console, last = Clock::time_point()](const Progress& progress) mutable {
    if (seconds_since(last) < 0.1) return;
    last = Clock::now();
    console.progress(progress_line(progress));
  };
}

/// A loaded, validated problem together with a planner that can solve it.
struct Prepared {
  Problem problem;
  std::unique_ptr<Planner> planner;
};

Result<Prepared> prepare(CLI::App& app, PlanCommand& command, Console& console) {
  Result<Problem> problem = load(command.files, console);
  if (!problem.ok()) return problem.error();
  if (command.planning.planner.empty()) {
    const std::string planner = std::holds_alternative<Retrieve>(problem->task) ? "em4m" : "selsim";
    if (Status status = settle_planner(app, command.planning, planner, console); !status.ok()) return status.error();
  }
  if (const Status status = validate(*problem); !status.ok()) return status.error();
  auto planner = make_planner(command.planning.planner);
  if (!planner) return Error{"unknown planner '" + command.planning.planner + "'", ErrorKind::usage};
  if (!planner->can_solve(problem->task))
    return Error{"planner " + planner->name() + " cannot do what " + problem->path + " asks (" + task_name(*problem) +
                     "); --planner chooses another, --task another task where the file allows both",
                 ErrorKind::usage};
  return Prepared{std::move(*problem), std::move(planner)};
}

/// What is printed if a signal comes and the planner does not end in time.
std::string interrupted_json(const Prepared& prepared, const PlanOptions& options) {
  PlanResult result;
  result.status = PlanStatus::interrupted;
  result.reason = "stopped by a signal";
  result.planner = prepared.planner->name();
  result.seed = options.seed;
  result.threads = options.threads;
  return io::result_json(result, prepared.problem) + "\n";
}

int report(const PlanCommand& command, const PlanResult& result, const Problem& problem, Console& console) {
  const std::string json = io::result_json(result, problem) + "\n";
  if (!command.out.empty())
    if (const Status status = io::write_file(command.out, json); !status.ok()) return fail(console, status.error());
  if (command.json) {
    std::fputs(json.c_str(), stdout);
    if (result.status == PlanStatus::proven) console.warn("proven under these assumptions:\n" + proven_assumptions());
  } else {
    std::fputs(summary(result, problem, console).c_str(), stdout);
    if (!command.out.empty()) std::printf("  %-12s %s\n", "written", command.out.c_str());
  }
  if (result.status != PlanStatus::solved && command.json) console.note(result.reason);
  return exit_code(result.status);
}

int run(CLI::App& app, PlanCommand& command, Console& console) {
  const Clock::time_point start = Clock::now();
  if (const Status status = complete(app, command.planning, console); !status.ok())
    return fail(console, status.error());
  const PlanningOptions& planning = command.planning;
  const io::LoadOptions& inputs = command.files.load;
  if (const Status status = check_outputs({command.out, planning.plan.trace_path},
                                          {command.files.problem, inputs.robot, inputs.srdf, planning.config});
      !status.ok())
    return fail(console, status.error());

  StopSource stop(planning.time_limit_s);
  SignalGuard signals(stop);
  const MemoryGuard memory(stop, planning.memory_limit_mb);
  const Result<Prepared> prepared = prepare(app, command, console);
  if (!prepared.ok()) return fail(console, prepared.error());
  const double load_s = seconds_since(start);
  if (command.json) signals.set_last_words(interrupted_json(*prepared, planning.plan));

  const Verifier judge;
  const PlanContext context{&stop, &judge, progress_printer(console)};
  PlanResult result;
  try {
    result = prepared->planner->plan(prepared->problem, planning.plan, context);
  } catch (const std::invalid_argument& error) {  // a planner-specific option out of range
    return fail(console, {error.what(), ErrorKind::usage});
  }
  console.end_progress();
  if (result.status == PlanStatus::solved && !result.verified)
    return fail(console,
                {"planner " + planning.planner + " returned a plan that was not verified", ErrorKind::internal});
  if (result.status == PlanStatus::error) return fail(console, {result.reason, ErrorKind::internal});
  if (result.status == PlanStatus::invalid) return fail(console, {result.reason, ErrorKind::invalid_input});
  result.reason = why_no_plan(result, planning.plan, planning.time_limit_s, planning.memory_limit_mb);
  result.stats.load_s = load_s;
  result.stats.wall_s = seconds_since(start);
  result.stats.peak_memory_mb = peak_memory_mb();
  return report(command, result, prepared->problem, console);
}

}  // namespace

void add_plan(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("plan", "Plan a problem and verify the plan");
  auto command = std::make_shared<PlanCommand>();
  add_problem(*sub, command->files);
  add_planning_options(*sub, command->planning);
  sub->add_option("--out", command->out, "Write the result object here")->type_name("FILE")->check(file_name());
  sub->add_flag("--json", command->json, "Print the result object instead of a summary");
  add_console_options(*sub, session);
  sub->footer("Example:\n  mamo plan problem.yaml --time-limit 60 --out plan.json\n" +
              describe_planner_options());
  sub->callback([sub, command, &session] {
    session.run = [sub, command, &session] { return run(*sub, *command, session.console); };
  });
}

}  // namespace mamo::tool
