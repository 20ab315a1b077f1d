// mamo generate: seeded random problems.
#include <filesystem>

#include "checks.hpp"
#include "exit_codes.hpp"
#include "interrupts.hpp"
#include "session.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/experiments/tabletop.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"

namespace mamo::tool {
namespace {

constexpr int kMostFiles = 100000;

struct TabletopCommand {
  TabletopSpec spec;
  int count = 1;
  std::string constraints = "contact-only", out;
};

/// Makes the folder if need be. An error of kind output when no file can be put there.
Status prepare_folder(const std::string& folder, const std::string& first_file) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    return Error{folder + ": cannot be made a folder (" + (error ? error.message() : "it is a file") + ")",
                 ErrorKind::output};
  return io::check_writable(first_file);
}

/// YAML files in the folder that this run has not written: they would be taken for its own.
int strangers(const std::string& folder, const std::vector<std::string>& written) {
  int found = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".yaml" &&
        std::find(written.begin(), written.end(), entry.path().filename()) == written.end())
      ++found;
  return found;
}

/// Does a path exist that touches no movable? Counts expansions, not seconds, so that the answer repeats.
bool solves_untouched(const Problem& problem, StopSource& stop) {
  Problem walls = problem;
  for (Object& object : walls.scene.objects) {
    if (!object.movable()) continue;
    object.kind = ObjectKind::immovable;
    object.constraints.touch = Touch::forbidden;
  }
  if (walls.robot.self_pairs.empty()) choose_self_pairs(walls.robot, walls.robot_files.disabled, false, 1);
  PlanOptions options;
  options.max_expansions = 20000;
  options.smooth = false;
  const auto planner = make_planner("selsim");
  return planner && planner->plan(walls, options, {&stop, nullptr, {}}).found;
}

int run(TabletopCommand& command, Console& console) {
  command.spec.profile = command.constraints == "full" ? Profile::full : Profile::contact_only;
  StopSource stop;
  const SignalGuard signals(stop);
  std::vector<Problem> problems;
  std::vector<std::string> names;
  for (int i = 0; i < command.count && !stop.stopped(); ++i) {
    command.spec.index = i;
    Result<Problem> problem = generate_tabletop(command.spec);
    if (!problem.ok()) return fail(console, problem.error());
    const std::string file = (std::filesystem::path(command.out) / problem->name).string();
    if (i == 0)
      if (const Status status = prepare_folder(command.out, file); !status.ok()) return fail(console, status.error());
    const Result<std::string> text = io::to_native_yaml(*problem);
    if (!text.ok()) return fail(console, text.error());
    if (const Status status = io::write_file(file, *text); !status.ok()) return fail(console, status.error());
    console.progress(format("%d of %d problems", i + 1, command.count));
    names.push_back(problem->name);
    problems.push_back(std::move(*problem));
  }
  console.end_progress();
  if (const int others = strangers(command.out, names); others > 0)
    console.warn(format("%s holds %d other .yaml files, left as they are", command.out.c_str(), others));
  std::printf("%zu problems in %s\n", problems.size(), command.out.c_str());
  std::fflush(stdout);

  int asked = 0;
  const ContactFreeCount count = count_contact_free(problems, [&](const Problem& problem) {
    console.progress(format("touching nothing: problem %d", ++asked));
    return solves_untouched(problem, stop);
  });
  console.end_progress();
  if (stop.stopped()) {
    console.error("mamo: interrupted");
    return kNoPlan;
  }
  std::printf("%s\n", count.text().c_str());
  return kSolved;
}

}  // namespace

void add_generate(CLI::App& app, Session& session) {
  CLI::App* generate = app.add_subcommand("generate", "Make random problems");
  generate->require_subcommand(1);
  const std::string example = "Example:\n  mamo generate tabletop --movable 10 --immovable 2 --count 20 --out problems";
  generate->footer(example);
  CLI::App* sub = generate->add_subcommand("tabletop", "Household things on a table, a goal pose amid them");
  auto command = std::make_shared<TabletopCommand>();
  sub->add_option("--movable", command->spec.movable, "Objects that may be pushed")
      ->type_name("N")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  sub->add_option("--immovable", command->spec.immovable, "Objects that must not be touched")
      ->type_name("M")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  sub->add_option("--seed", command->spec.seed, "Of every random stream")
      ->type_name("S")
      ->check(whole_number(0))
      ->capture_default_str();
  sub->add_option("--count", command->count, "Files to write; file i does not depend on it")
      ->type_name("K")
      ->check(whole_number(1, kMostFiles))
      ->capture_default_str();
  sub->add_option("--constraints", command->constraints, "Profile: contact-only or full")
      ->type_name("PROFILE")
      ->check(one_of({"contact-only", "full"}))
      ->capture_default_str();
  sub->add_option("--out", command->out, "Folder for the files, made if need be")
      ->type_name("DIR")
      ->required()
      ->check(file_name());
  add_console_options(*sub, session);
  sub->footer(example);
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
