// mamo verify: does this plan hold in full physics?
#include "checks.hpp"
#include "exit_codes.hpp"
#include "file_options.hpp"
#include "interrupts.hpp"
#include "plan_file.hpp"
#include "session.hpp"
#include "summary.hpp"

#include "mamo/io/result_json.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo::tool {
namespace {

struct VerifyCommand {
  FileOptions files;
  std::string plan;
  bool json = false;
};

void print(const VerifyCommand& command, const Plan& plan, const Problem& problem, const Verdict& verdict,
           const Console& console) {
  const std::string where = command.plan + " in " + problem.name;
  if (verdict.ok) {
    std::printf("%s: %s\n  %-12s %s\n", console.coloured("holds", true).c_str(), where.c_str(), "plan",
                plan_line(plan, problem.scene).c_str());
    return;
  }
  std::printf("%s: %s\n", console.coloured("does not hold", false).c_str(), where.c_str());
  for (const Verdict::Finding& finding : verdict.findings) std::printf("  %s\n", one_line(finding.text).c_str());
}

int run(const VerifyCommand& command, Console& console) {
  StopSource stop;
  const SignalGuard signals(stop);
  const Result<Problem> problem = load(command.files, console);
  if (!problem.ok()) return fail(console, problem.error());
  const Result<Plan> plan = io::load_plan(command.plan, *problem);
  if (!plan.ok()) return fail(console, plan.error());
  const std::string made_for = read_plan_facts(command.plan).problem_sha256;
  if (!made_for.empty() && made_for != problem->sha256)
    console.warn(command.plan + ": made for another problem file than " + problem->path + " (problem_sha256 differs)");

  const Verdict verdict = Verifier().judge(*problem, *plan, stop);
  if (verdict.stopped) {
    console.error("mamo: interrupted, no verdict");
    return kNoPlan;
  }
  if (command.json)
    std::puts(io::verdict_json(verdict, problem->scene).c_str());
  else
    print(command, *plan, *problem, verdict, console);
  return verdict.ok ? kSolved : kDoesNotHold;
}

}  // namespace

void add_verify(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("verify", "Replay a plan in full physics and judge it");
  auto command = std::make_shared<VerifyCommand>();
  add_problem(*sub, command->files);
  sub->add_option("PLAN", command->plan, "Result object of `mamo plan`, or its bare plan")
      ->required()
      ->check(file_name());
  sub->add_flag("--json", command->json, "Print the verdict object instead of a summary");
  add_console_options(*sub, session);
  sub->footer("Exit code 0: it holds; 4: it does not.\nExample:\n  mamo verify problem.yaml plan.json");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
