// mamo convert: scenes to native problems, plans to trajectories.
#include <filesystem>

#include "checks.hpp"
#include "exit_codes.hpp"
#include "file_options.hpp"
#include "kind_of_file.hpp"
#include "output_files.hpp"
#include "plan_file.hpp"
#include "session.hpp"

#include "mamo/io/trajectory.hpp"

namespace mamo::tool {
namespace {

const std::vector<std::string> kTo = {"problem", "csv", "trajectory"};

struct ConvertCommand {
  FileOptions files;  // files.problem is INPUT when that is a problem
  std::string output, from, to, problem;
  bool ros1 = false;
};

/// The target format: --to, else what the output is called.
Result<std::string> target(const ConvertCommand& command, bool input_is_plan) {
  std::string to = command.to;
  if (to.empty()) {
    const std::string extension = std::filesystem::path(command.output).extension();
    if (extension == ".csv") to = "csv";
    if (extension == ".yaml" || extension == ".yml") to = input_is_plan ? "trajectory" : "problem";
  }
  const std::string input = command.files.problem;
  if (to.empty())
    return Error{"cannot tell the format of " + command.output + "; --to names it (" + join(kTo) + ")",
                 ErrorKind::usage};
  if (input_is_plan && to == "problem")
    return Error{input + " is a plan; it converts to csv or trajectory", ErrorKind::usage};
  if (!input_is_plan && to != "problem") return Error{input + " is no plan; it converts to problem", ErrorKind::usage};
  return to;
}

Result<std::string> convert_plan(const ConvertCommand& command, const std::string& to, Console& console) {
  Problem problem;
  if (command.problem.empty()) {
    problem = stand_in_problem(command.files.problem);
  } else {
    FileOptions files = command.files;
    files.problem = command.problem;
    Result<Problem> loaded = load(files, console);
    if (!loaded.ok()) return loaded.error();
    problem = std::move(*loaded);
  }
  const Result<Plan> plan = io::load_plan(command.files.problem, problem);
  if (!plan.ok()) return plan.error();
  if (to == "csv") return io::trajectory_csv(*plan, problem);
  return io::joint_trajectory_yaml(*plan, problem, command.ros1);
}

int run(const ConvertCommand& command, Console& console) {
  const std::string& input = command.files.problem;
  if (const Status status = check_outputs({command.output}, {input, command.problem}); !status.ok())
    return fail(console, status.error());
  Result<FileKind> kind = command.from.empty()
                              ? kind_of_file(input)
                              : Result<FileKind>(command.from == "plan" ? FileKind::plan : FileKind::problem);
  if (!kind.ok()) return fail(console, kind.error());
  if (*kind == FileKind::robot)
    return fail(console, {input + " is a robot; convert takes a problem or a plan", ErrorKind::usage});
  const Result<std::string> to = target(command, *kind == FileKind::plan);
  if (!to.ok()) return fail(console, to.error());

  Result<std::string> text = std::string();
  if (*kind == FileKind::plan) {
    text = convert_plan(command, *to, console);
  } else {
    const Result<Problem> problem = load(command.files, console);
    if (!problem.ok()) return fail(console, problem.error());
    text = io::to_native_yaml(*problem);
  }
  if (!text.ok()) return fail(console, text.error());
  if (const Status status = io::write_file(command.output, *text); !status.ok()) return fail(console, status.error());
  std::printf("%s\n", command.output.c_str());
  return kSolved;
}

}  // namespace

void add_convert(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("convert", "Scene to native problem; plan to CSV or JointTrajectory");
  auto command = std::make_shared<ConvertCommand>();
  sub->add_option("INPUT", command->files.problem, "A problem of any known format, or a plan")
      ->required()
      ->check(file_name());
  sub->add_option("OUTPUT", command->output, "Its extension chooses the format unless --to does")
      ->required()
      ->check(file_name());
  sub->add_option("--from", command->from, "problem or plan; known by its content otherwise")
      ->type_name("FORMAT")
      ->check(one_of({"problem", "plan"}));
  sub->add_option("--to", command->to, "One of: " + join(kTo))->type_name("FORMAT")->check(one_of(kTo));
  sub->add_option("--problem", command->problem, "Problem of the plan, to check it against")
      ->type_name("FILE")
      ->check(file_name());
  sub->add_flag("--ros1", command->ros1, "Times of the trajectory as ROS 1 names them");
  add_file_options(*sub, command->files);
  add_console_options(*sub, session);
  sub->footer("Example:\n  mamo convert plan_100000_SCENE.txt problem.yaml\n  mamo convert plan.json trajectory.csv");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
