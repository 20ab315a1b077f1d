#include "io/native_problem.hpp"

#include "io/object_reader.hpp"
#include "io/robot_request.hpp"
#include "io/task_reader.hpp"
#include "io/text.hpp"

namespace mamo::io {
namespace {

PhysicsSettings read_physics(const YamlValue& value, Complaints& complaints) {
  PhysicsSettings physics;
  StrictMap map(value, "physics", {"step", "iterations", "robot_friction", "settle_time"}, complaints);
  physics.step = map.number("step", physics.step, {1e-5, 0.05, false, "a positive time (1e-5 to 0.05 s)"});
  const double iterations =
      map.number("iterations", physics.iterations, {1, 10000, false, "a whole number from 1 to 10000"});
  physics.iterations = static_cast<int>(iterations);
  if (physics.iterations != iterations)
    complaints.add(map.need("iterations"), map.name_of("iterations") + " must be a whole number");
  physics.robot_friction = map.number("robot_friction", physics.robot_friction, kFriction);
  physics.settle_time = map.number("settle_time", physics.settle_time, {0, 600, false, "a time from 0 to 600 s"});
  return physics;
}

/// A file that was generated ends with `end: true`, so that half a file is never taken for a whole one.
void check_end(const YamlValue& root, Complaints& complaints) {
  const YamlValue* end = root.find("end");
  if (!end) {
    if (const YamlValue* generated = root.find("generated"))
      complaints.add(*generated, "the file is truncated: it has 'generated' but does not end with 'end: true'");
    return;
  }
  if (!read_truth(*end, "end", complaints)) complaints.add(*end, "end must be true");
  if (root.members.back().key != "end") complaints.add(*end, "'end: true' must be the last key of the file");
}

std::map<std::string, std::string> read_notes(const YamlValue& value, Complaints& complaints) {
  std::map<std::string, std::string> notes;
  if (!value.is_map()) complaints.add(value, "generated must be a map of notes");
  for (const YamlMember& m : value.members) {
    if (!m.value.is_scalar()) complaints.add(m.value, "generated: " + in_quotes(m.key) + " must be a single value");
    notes[m.key] = m.value.scalar;
  }
  return notes;
}

}  // namespace

void read_native_problem(const YamlValue& root, const LoadOptions& options, Problem& problem, Complaints& complaints) {
  StrictMap map(root, "the problem",
                {"format", "robot", "task", "objects", "constraints", "physics", "generated", "end"}, complaints);
  const YamlValue& format = map.need("format");
  if (format.is_scalar() && format.scalar != "mamo-problem/1")
    complaints.add(format, "format is " + in_quotes(format.scalar) + ", expected mamo-problem/1");
  check_end(root, complaints);
  if (const YamlValue* generated = map.find("generated")) problem.generated = read_notes(*generated, complaints);
  if (const YamlValue* physics = map.find("physics")) problem.scene.physics = read_physics(*physics, complaints);
  if (complaints.any()) return;

  const YamlValue* common = map.find("constraints");
  problem.profile = read_profile(common, options, complaints);
  const YamlValue* robot = map.find("robot");
  RobotRequest request;
  if (robot || options.robot.empty()) request = read_robot(map.need("robot"), complaints);
  for (auto& [name, folder] : request.package_path) {
    const Result<std::string> found = find_data_file(folder, problem.path);
    if (found)
      folder = *found;
    else
      complaints.add(*robot->find("package_path"), "package_path: " + found.error().message);
  }
  const ObjectContext context{options, problem.path, request.package_path, problem.profile, common};
  if (const YamlValue* objects = map.find("objects"))
    problem.scene.objects = read_objects(*objects, context, complaints);
  const YamlValue& task = map.need("task");
  if (complaints.any()) return;

  install_robot(std::move(request), options, robot, problem, complaints);
  if (complaints.any()) return;
  problem.task = read_task(task, problem, complaints);
}

}  // namespace mamo::io
