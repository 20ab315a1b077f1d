// mamo generate: seeded random problems.
#include "checks.hpp"
#include "exit_codes.hpp"
#include "generated_files.hpp"
#include "interrupts.hpp"
#include "session.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/experiments/refrigerator.hpp"
#include "mamo/experiments/shelf.hpp"
#include "mamo/experiments/tabletop.hpp"
#include "mamo/planners/registry.hpp"

namespace mamo::tool {
namespace {

constexpr int kMostFiles = 100000;

struct TabletopCommand {
  TabletopSpec spec;
  int count = 1;
  std::string constraints = "contact-only", out;
};

struct ShelfCommand {
  ShelfSpec spec;
  int count = 1;
  std::string constraints = "full", difficulty, out;
};

struct RefrigeratorCommand {
  RefrigeratorSpec spec;
  int count = 1;
  std::string constraints = "full", out;
};

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

Profile profile_of(const std::string& constraints) {
  return constraints == "full" ? Profile::full : Profile::contact_only;
}

int run(TabletopCommand& command, Console& console) {
  command.spec.profile = profile_of(command.constraints);
  StopSource stop;
  const SignalGuard signals(stop);
  const auto problems = write_problems(
      command.out, command.count,
      [&](int i) {
        command.spec.index = i;
        return generate_tabletop(command.spec);
      },
      stop, console);
  if (!problems.ok()) return fail(console, problems.error());

  int asked = 0;
  const ContactFreeCount count = count_contact_free(*problems, [&](const Problem& problem) {
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

/// Retrieval problems, and how hard they are. `make` is called with the index of each.
int run_retrievals(const std::string& out, int count, const std::function<Result<Problem>(int)>& make,
                   Console& console) {
  StopSource stop;
  const SignalGuard signals(stop);
  const auto problems = write_problems(out, count, make, stop, console);
  if (!problems.ok()) return fail(console, problems.error());
  if (stop.stopped()) {
    console.error("mamo: interrupted");
    return kNoPlan;
  }
  std::map<std::string, int> of;
  for (const Problem& problem : *problems) ++of[problem.generated.at("difficulty")];
  std::printf("%d easy, %d medium, %d hard, %d with nothing in the way\n", of["easy"], of["medium"], of["hard"],
              of["none"]);
  return kSolved;
}

int run(ShelfCommand& command, Console& console) {
  command.spec.profile = profile_of(command.constraints);
  command.spec.difficulty = parse_difficulty(command.difficulty);
  return run_retrievals(
      command.out, command.count,
      [&](int i) {
        command.spec.index = i;
        return generate_shelf(command.spec);
      },
      console);
}

int run(RefrigeratorCommand& command, Console& console) {
  command.spec.profile = profile_of(command.constraints);
  return run_retrievals(
      command.out, command.count,
      [&](int i) {
        command.spec.index = i;
        return generate_refrigerator(command.spec);
      },
      console);
}

template <class Command>
void add_numbers(CLI::App& sub, Command& command) {
  sub.add_option("--movable", command.spec.movable, "Objects that may be pushed")
      ->type_name("N")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  sub.add_option("--immovable", command.spec.immovable, "Objects that must not be touched")
      ->type_name("M")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
}

/// What every generator takes. The commands outlive their options.
template <class Command>
void add_common(CLI::App& sub, Command& command) {
  sub.add_option("--seed", command.spec.seed, "Of every random stream")
      ->type_name("S")
      ->check(whole_number(0))
      ->capture_default_str();
  sub.add_option("--count", command.count, "Files to write; file i does not depend on it")
      ->type_name("K")
      ->check(whole_number(1, kMostFiles))
      ->capture_default_str();
  sub.add_option("--constraints", command.constraints, "Profile: contact-only or full")
      ->type_name("PROFILE")
      ->check(one_of({"contact-only", "full"}))
      ->capture_default_str();
  sub.add_option("--out", command.out, "Folder for the files, made if need be")
      ->type_name("DIR")
      ->required()
      ->check(file_name());
}

void add_tabletop(CLI::App& generate, Session& session, const std::string& example) {
  CLI::App* sub = generate.add_subcommand("tabletop", "Household things on a table, a goal pose amid them");
  auto command = std::make_shared<TabletopCommand>();
  add_numbers(*sub, *command);
  add_common(*sub, *command);
  add_console_options(*sub, session);
  sub->footer(example);
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

void add_shelf(CLI::App& generate, Session& session, const std::string& example) {
  CLI::App* sub = generate.add_subcommand("shelf", "A crowded shelf, one thing to fetch out of it");
  auto command = std::make_shared<ShelfCommand>();
  add_numbers(*sub, *command);
  add_common(*sub, *command);
  sub->add_option("--difficulty", command->difficulty,
                  "Draw until 1 (easy), 2 (medium) or more (hard) movables are in the way")
      ->type_name("CLASS")
      ->check(one_of({"easy", "medium", "hard"}));
  add_console_options(*sub, session);
  sub->footer(example);
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

void add_refrigerator(CLI::App& generate, Session& session, const std::string& example) {
  CLI::App* sub = generate.add_subcommand("refrigerator", "Five household things in a compartment, a can to fetch");
  auto command = std::make_shared<RefrigeratorCommand>();
  add_common(*sub, *command);
  add_console_options(*sub, session);
  sub->footer(example);
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace

void add_generate(CLI::App& app, Session& session) {
  CLI::App* generate = app.add_subcommand("generate", "Make random problems");
  generate->require_subcommand(1);
  const std::string table = "Example:\n  mamo generate tabletop --movable 10 --immovable 2 --count 20 --out problems";
  const std::string shelf =
      "Example:\n  mamo generate shelf --movable 10 --immovable 4 --difficulty medium --out problems";
  const std::string fridge = "Example:\n  mamo generate refrigerator --count 20 --out problems";
  generate->footer(table);
  add_tabletop(*generate, session, table);
  add_shelf(*generate, session, shelf);
  add_refrigerator(*generate, session, fridge);
}

}  // namespace mamo::tool
