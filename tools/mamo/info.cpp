// mamo info: what was understood of a robot, a problem or a plan; a top view.
#include "checks.hpp"
#include "exit_codes.hpp"
#include "file_options.hpp"
#include "kind_of_file.hpp"
#include "output_files.hpp"
#include "plan_file.hpp"
#include "session.hpp"
#include "summary.hpp"

#include "mamo/io/robot_setup.hpp"
#include "mamo/view/describe.hpp"
#include "mamo/view/top_view.hpp"

namespace mamo::tool {
namespace {

struct InfoCommand {
  FileOptions files;  // files.problem is FILE
  std::string problem, svg;
};

/// What is printed, and what can be drawn.
struct Info {
  std::string text, picture;
};

Error no_picture(const std::string& what) {
  return {"--svg draws problems, and plans with --problem FILE; " + what, ErrorKind::usage};
}

/// Nobody said which joints plan: all that can move, parked at 0 or at the limit next to it.
Robot whole_robot(std::shared_ptr<const RobotModel> model) {
  Robot robot;
  robot.group = {model->variable_joint, LinkId{0}, LinkId(model->links.size() - 1)};
  robot.posture = Eigen::VectorXd::Zero(model->variables);
  for (int i = 0; i < model->variables; ++i) {
    const Joint& joint = model->joints[model->variable_joint[static_cast<std::size_t>(i)].index()];
    robot.posture[i] = std::clamp(0.0, joint.lower, joint.upper);
  }
  robot.model = std::move(model);
  return robot;
}

Result<Info> robot_info(const InfoCommand& command, Console& console) {
  if (!command.svg.empty()) return no_picture(command.files.problem + " is a robot");
  const io::LoadOptions options = load_options(command.files);
  const auto description = io::load_urdf(command.files.problem, options.package_path);
  if (!description.ok()) return description.error();
  console.warn_all(description->warnings);
  if (options.tip.empty() && options.group.empty()) return Info{view::describe(whole_robot(description->model)), ""};

  io::Srdf srdf;
  if (!options.srdf.empty()) {
    Result<io::Srdf> loaded = io::load_srdf(options.srdf, *description->model);
    if (!loaded.ok()) return loaded.error();
    srdf = std::move(*loaded);
  }
  io::GroupSpec spec;
  spec.base = options.base;
  spec.tip = options.tip;
  spec.group = options.group;
  spec.srdf = &srdf;
  const Result<Robot> robot = io::make_robot(*description, spec);
  if (!robot.ok()) return Error{command.files.problem + ": " + robot.error().message, robot.error().kind};
  return Info{view::describe(*robot), ""};
}

Result<Info> problem_info(const InfoCommand& command, Console& console) {
  const Result<Problem> problem = load(command.files, console);
  if (!problem.ok()) return problem.error();
  return Info{view::describe(*problem), command.svg.empty() ? "" : view::top_view_svg(*problem)};
}

std::string facts_line(const std::string& path) {
  const PlanFacts facts = read_plan_facts(path);
  if (facts.planner.empty()) return "";
  return "result of " + facts.planner + " for " + facts.problem + ": " + facts.status + ", signature " +
         facts.signature + "\n";
}

Result<Info> plan_info(const InfoCommand& command, Console& console) {
  const std::string& path = command.files.problem;
  if (command.problem.empty()) {
    if (!command.svg.empty()) return no_picture("which problem is " + path + " for?");
    const Problem stand_in = stand_in_problem(path);
    const Result<Plan> plan = io::load_plan(path, stand_in);
    if (!plan.ok()) return plan.error();
    return Info{facts_line(path) + view::describe(*plan, stand_in), ""};
  }
  FileOptions files = command.files;
  files.problem = command.problem;
  const Result<Problem> problem = load(files, console);
  if (!problem.ok()) return problem.error();
  const Result<Plan> plan = io::load_plan(path, *problem);
  if (!plan.ok()) return plan.error();
  return Info{facts_line(path) + view::describe(*plan, *problem),
              command.svg.empty() ? "" : view::top_view_svg(*problem, &*plan)};
}

Result<Info> inspect(const InfoCommand& command, Console& console) {
  const Result<FileKind> kind = kind_of_file(command.files.problem);
  if (!kind.ok()) return kind.error();
  switch (*kind) {
    case FileKind::robot:
      return robot_info(command, console);
    case FileKind::problem:
      return problem_info(command, console);
    case FileKind::plan:
      return plan_info(command, console);
  }
  return Error{"unknown kind of file", ErrorKind::internal};
}

int run(const InfoCommand& command, Console& console) {
  if (const Status status = check_outputs({command.svg}, {command.files.problem, command.problem}); !status.ok())
    return fail(console, status.error());
  const Result<Info> info = inspect(command, console);
  if (!info.ok()) return fail(console, info.error());
  if (!command.svg.empty())
    if (const Status status = io::write_file(command.svg, info->picture); !status.ok())
      return fail(console, status.error());
  std::fputs(info->text.c_str(), stdout);
  return kSolved;
}

}  // namespace

void add_info(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("info", "What was understood of a robot, a problem or a plan; a top view");
  auto command = std::make_shared<InfoCommand>();
  sub->add_option("FILE", command->files.problem, "Robot (URDF), problem or plan, known by its content")
      ->required()
      ->check(file_name());
  sub->add_option("--svg", command->svg, "Write a picture from above")->type_name("FILE")->check(file_name());
  sub->add_option("--problem", command->problem, "Problem of a plan")->type_name("FILE")->check(file_name());
  add_file_options(*sub, command->files);
  add_console_options(*sub, session);
  sub->footer(
      "Example:\n  mamo info problem.yaml --svg top.svg\n"
      "  mamo info plan.json --problem problem.yaml --svg plan.svg");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
