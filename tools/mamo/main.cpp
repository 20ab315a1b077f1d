// The command-line tool: parse, run one subcommand, map what happened to an exit code.
#include <cstdio>
#include <exception>
#include <new>

#include "checks.hpp"
#include "exit_codes.hpp"
#include "session.hpp"

namespace mamo::tool {
namespace {

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

/// The innermost subcommand that was named on the command line.
const CLI::App* chosen(const CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return app;
}

std::string full_name(const CLI::App* app) {
  return app->get_parent() ? full_name(app->get_parent()) + " " + app->get_name() : app->get_name();
}

/// Unknown words get the nearest known one; CLI11's own text serves for the rest.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = chosen(&app);
  const std::vector<std::string> extras = command->remaining();
  const auto subcommands = names_of(command->get_subcommands(nullptr));
  std::string text = error.what();
  if (!extras.empty() && extras.front().starts_with("-")) {
    std::vector<std::string> options;
    for (const CLI::Option* option : command->get_options())
      if (!option->get_lnames().empty()) options.push_back("--" + option->get_lnames().front());
    const std::string word = extras.front().substr(0, extras.front().find('='));
    text = "unknown option '" + word + "'" + did_you_mean(word, options);
  } else if (!subcommands.empty()) {
    text = extras.empty() ? "no subcommand given"
                          : "unknown subcommand '" + extras.front() + "'" + did_you_mean(extras.front(), subcommands);
    text += "; there are: " + join(subcommands);
  } else if (!extras.empty()) {
    text = "unexpected argument '" + extras.front() + "'";
  }
  return text + "; see '" + full_name(command) + " --help'";
}

int run(int argc, char** argv) {
  Session session;
  CLI::App app{"Planning for robot arms among movable objects.", "mamo"};
  app.set_version_flag("--version", "mamo " MAMO_VERSION);
  app.set_help_flag("-h,--help", "Print this help");
  app.require_subcommand(1);
  app.footer(
      "Example:\n  mamo plan problem.yaml --out plan.json && mamo verify problem.yaml plan.json\n"
      "Each subcommand has its own --help.");
  add_plan(app, session);
  add_verify(app, session);
  add_generate(app, session);
  add_view(app, session);
  add_info(app, session);
  add_convert(app, session);
  add_bench(app, session);
  add_report(app, session);
  add_train(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_text) {  // --help, --version
    return app.exit(asked_for_text);
  } catch (const CLI::ParseError& error) {
    return fail(session.console, {explain(app, error), ErrorKind::usage});
  }
  try {
    const int code = session.run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail(session.console, {"standard output cannot be written", ErrorKind::output});
    return code;
  } catch (const std::bad_alloc&) {
    session.console.error("mamo: out of memory; --memory-limit MB stops a run before the machine is full");
    return kNoPlan;
  } catch (const std::exception& error) {
    return fail(session.console, {std::string("internal error: ") + error.what(), ErrorKind::internal});
  }
}

}  // namespace
}  // namespace mamo::tool

int main(int argc, char** argv) { return mamo::tool::run(argc, argv); }
