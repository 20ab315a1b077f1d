#include "io/task_reader.hpp"

#include "io/text.hpp"

#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

constexpr NumberRule kTolerance{1e-6, 10, false, "a positive tolerance (1e-6 to 10)"};

ObjectId read_object_name(const YamlValue& value, const std::string& what, const Scene& scene, Complaints& complaints) {
  const std::string name = read_text(value, what, complaints);
  const ObjectId id = scene.find(name);
  if (id.valid() || complaints.any()) return id;
  std::vector<std::string> known;
  for (const Object& o : scene.objects) known.push_back(o.id);
  complaints.add(value, what + " is " + in_quotes(name) + ", no object has that id" +
                            (known.empty() ? "" : ", the nearest is " + in_quotes(nearest_name(name, known))));
  return kNoObject;
}

/// A value for every joint of the group, inside its limits.
Eigen::VectorXd read_group_joints(const YamlValue& value, const std::string& what, const Robot& robot,
                                  Complaints& complaints) {
  std::vector<std::string> names;
  for (int i = 0; i < robot.dof(); ++i) names.push_back(robot.joint(i).name);
  StrictMap map(value, what, names, complaints);
  Eigen::VectorXd q(robot.dof());
  for (int i = 0; i < robot.dof(); ++i) {
    q[i] = map.need_number(names[static_cast<std::size_t>(i)], kAnyNumber);
    const Joint& joint = robot.joint(i);
    if (q[i] < joint.lower - 1e-6 || q[i] > joint.upper + 1e-6)
      complaints.add(map.need(joint.name), "joint " + in_quotes(joint.name) + " of " + what + " is " +
                                               shortest_number(q[i]) + ", outside its limits " +
                                               shortest_number(joint.lower) + " to " + shortest_number(joint.upper));
    q[i] = std::clamp(q[i], joint.lower, joint.upper);
  }
  return q;
}

Task read_reach(StrictMap& map, const Problem& problem, Complaints& complaints) {
  if (map.has("pose") == map.has("joints")) map.complain("task reach needs either 'pose' or 'joints'");
  if (const YamlValue* joints = map.find("joints")) {
    ReachJoints reach;
    if (map.has("target")) map.complain("task reach of joints has no 'target'");
    reach.q = read_group_joints(*joints, "joints of task", problem.robot, complaints);
    reach.tolerance = map.number("tolerance", reach.tolerance, kTolerance);
    return reach;
  }
  ReachPose reach;
  reach.X_WT = read_pose(map.need("pose"), "pose of task", complaints);
  if (const YamlValue* tolerance = map.find("tolerance")) {
    StrictMap numbers(*tolerance, "tolerance of task", {"position", "angle", "angle_deg"}, complaints);
    reach.position_tolerance = numbers.number("position", reach.position_tolerance, kTolerance);
    reach.angle_tolerance = numbers.number("angle", reach.angle_tolerance, kTolerance);
    if (const YamlValue* degrees = numbers.find("angle_deg")) {
      if (numbers.has("angle")) numbers.complain("tolerance of task gives both angle and angle_deg");
      const NumberRule rule{1e-4, 360, false, "a positive angle (up to 360 degrees)"};
      reach.angle_tolerance = read_number(*degrees, numbers.name_of("angle_deg"), rule, complaints) * (EIGEN_PI / 180);
    }
  }
  if (const YamlValue* target = map.find("target"))
    reach.target = read_object_name(*target, "target of task", problem.scene, complaints);
  return reach;
}

Task read_retrieve(StrictMap& map, const Problem& problem, Complaints& complaints) {
  Retrieve retrieve;
  const YamlValue& object = map.need("object");
  retrieve.object = read_object_name(object, "object of task", problem.scene, complaints);
  if (retrieve.object.valid() && problem.scene[retrieve.object].fixture())
    complaints.add(object,
                   "object of task is the fixture " + in_quotes(object.scalar) + ", only an object can be retrieved");
  retrieve.X_WT_pregrasp = read_pose(map.need("pregrasp"), "pregrasp of task", complaints);
  retrieve.home = problem.q_start;
  if (const YamlValue* home = map.find("home"); home && !(home->is_scalar() && home->scalar == "start"))
    retrieve.home = read_group_joints(*home, "home of task", problem.robot, complaints);
  retrieve.home_tolerance = map.number("tolerance", retrieve.home_tolerance, kTolerance);
  return retrieve;
}

}  // namespace

Task read_task(const YamlValue& value, const Problem& problem, Complaints& complaints) {
  const YamlValue* kind = value.find("kind");
  const std::string name = kind && kind->is_scalar() ? kind->scalar : "";
  if (name == "reach") {
    StrictMap map(value, "task", {"kind", "pose", "joints", "tolerance", "target"}, complaints);
    return read_reach(map, problem, complaints);
  }
  if (name == "retrieve") {
    StrictMap map(value, "task", {"kind", "object", "pregrasp", "home", "tolerance"}, complaints);
    return read_retrieve(map, problem, complaints);
  }
  if (!value.is_map())
    complaints.add(value, "task must be a map with a 'kind'");
  else if (!kind)
    complaints.add(value, "task misses the key 'kind' (reach or retrieve)");
  else
    complaints.add(*kind, "kind of task is " + in_quotes(name) + ", expected reach or retrieve");
  return ReachPose{};
}

Status change_task(const std::string& wanted, Problem& problem) {
  const auto wrong = [](const std::string& message) { return Error{message, ErrorKind::usage}; };
  if (wanted.empty()) return {};
  if (wanted == "reach") {
    if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) {
      ReachPose reach;
      reach.X_WT = retrieve->X_WT_pregrasp;
      reach.target = retrieve->object;
      problem.task = reach;
    }
    return {};
  }
  if (wanted != "retrieve") return wrong("--task is " + in_quotes(wanted) + ", expected reach or retrieve");
  if (std::holds_alternative<Retrieve>(problem.task)) return {};
  const ReachPose* reach = std::get_if<ReachPose>(&problem.task);
  if (!reach || !reach->target.valid() || problem.scene[reach->target].fixture())
    return wrong("--task retrieve: the problem names no object to retrieve (a reach of a pose with a 'target' would)");
  Retrieve retrieve;
  retrieve.object = reach->target;
  retrieve.X_WT_pregrasp = reach->X_WT;
  retrieve.home = problem.q_start;
  problem.task = retrieve;
  return {};
}

void protect_target(Problem& problem) {
  const ReachPose* reach = std::get_if<ReachPose>(&problem.task);
  if (!reach || !reach->target.valid()) return;
  Object& target = problem.scene.objects[reach->target.index()];
  if (!target.fixture()) target.constraints.touch = Touch::forbidden;
}

}  // namespace mamo::io
