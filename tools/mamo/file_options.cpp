#include "file_options.hpp"

#include "checks.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo::tool {
namespace {

constexpr std::uint64_t kSelfPairSeed = 1;  // not --seed: the robot is the same whatever the planner draws

}  // namespace

void add_problem(CLI::App& command, FileOptions& options) {
  command
      .add_option("PROBLEM", options.problem, "Native problem (YAML) or published shelf scene, known by its content")
      ->required()
      ->check(file_name());
  add_file_options(command, options);
}

void add_file_options(CLI::App& command, FileOptions& options) {
  const char* group = "Input files";
  const auto file = [&](const char* name, std::string& target, const char* help) {
    command.add_option(name, target, help)->type_name("FILE")->check(file_name())->group(group);
  };
  const auto text = [&](const char* name, std::string& target, const char* help) {
    command.add_option(name, target, help)->type_name("NAME")->check(file_name())->group(group);
  };
  file("--robot", options.load.robot, "URDF that replaces the problem's robot");
  file("--srdf", options.load.srdf, "SRDF of the robot: groups, disabled collision pairs");
  text("--group", options.load.group, "Planning group of the SRDF (with --robot)");
  text("--base", options.load.base, "First link of the planning chain (with --robot)");
  text("--tip", options.load.tip, "Link that is sent to poses (with --robot)");
  command.add_option("--package-path", options.package_paths, "Where package://NAME/... is; repeatable")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false)
      ->check(assignment("NAME=DIR"))
      ->group(group);
  command.add_option("--task", options.load.task, "reach or retrieve, where the file allows both")
      ->type_name("KIND")
      ->check(one_of({"reach", "retrieve"}))
      ->group(group);
  command.add_option("--constraints", options.load.constraints, "Profile that replaces the file's own")
      ->type_name("PROFILE")
      ->check(one_of({"contact-only", "full", "legacy"}))
      ->group(group);
  command.add_option("--movable", options.load.movable, "Glob of object ids to make movable; repeatable")
      ->type_name("GLOB")
      ->allow_extra_args(false)
      ->group(group);
  options.mass_option = command.add_option("--default-mass", options.default_mass, "kg, where a file states none")
                            ->type_name("KG")
                            ->check(number_above(0))
                            ->group(group);
  options.friction_option =
      command.add_option("--default-friction", options.default_friction, "Coefficient, where a file states none")
          ->type_name("MU")
          ->check(number_at_least(0))
          ->group(group);
}

io::LoadOptions load_options(const FileOptions& options) {
  io::LoadOptions load = options.load;
  for (const std::string& text : options.package_paths) {
    const std::size_t equals = text.find('=');
    load.package_path[text.substr(0, equals)] = text.substr(equals + 1);
  }
  if (options.mass_option && options.mass_option->count()) load.default_mass = options.default_mass;
  if (options.friction_option && options.friction_option->count()) load.default_friction = options.default_friction;
  return load;
}

Result<Problem> load(const FileOptions& options, Console& console) {
  Result<Problem> problem = io::load_problem(options.problem, load_options(options));
  if (!problem.ok()) return problem;
  console.warn_all(problem->warnings);
  // Reading a file knows no collision checker: which links to test against each other is settled here.
  Robot& robot = problem->robot;
  choose_self_pairs(robot, problem->robot_files.disabled, !problem->robot_files.srdf.empty(), kSelfPairSeed);
  for (const auto& [a, b] : robot.disabled_pairs)
    console.note("links '" + robot.model->links[a.index()].name + "' and '" + robot.model->links[b.index()].name +
                 "' are not tested against each other: they collide always or at the start");
  return problem;
}

}  // namespace mamo::tool
