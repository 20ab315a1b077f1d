#include "mamo/planners/validate.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"

namespace mamo {
namespace {

Error invalid(const Problem& problem, const std::string& what) { return {problem.path + ": " + what}; }

Status check_start(const Problem& problem, CollisionChecker& checker) {
  ObjectSet everything = ObjectSet::all(problem.scene);
  for (std::size_t i = 0; i < problem.scene.size(); ++i) everything.insert(ObjectId(i));
  CollisionReport report;
  checker.check(problem.q_start, everything, false, report);
  const auto& links = problem.robot.model->links;
  if (report.self)
    return invalid(problem, "the start configuration is in collision: links '" +
                                links[report.first_self.first.index()].name + "' and '" +
                                links[report.first_self.second.index()].name + "' of the robot");
  for (ObjectId id : report.touched) {
    const Object& object = problem.scene[id];
    if (object.fixture() && robot_may_touch(object.constraints.touch)) continue;
    return invalid(problem, "the start configuration is in collision: the robot hits '" + object.id + "'");
  }
  return {};
}

Status check_objects(const Problem& problem, CollisionChecker& checker) {
  const Scene& scene = problem.scene;
  const WorldState start = WorldState::start_of(scene);
  for (const auto& [a, b] : checker.overlapping_objects(kMaxStartOverlap))
    if (!scene[a].fixture() || !scene[b].fixture())
      return invalid(problem, "objects '" + scene[a].id + "' and '" + scene[b].id + "' overlap at the start");
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const ObjectId id(i);
    if (scene[id].fixture() || scene[id].mass <= 0) continue;
    WorldState lowered = start;  // an object that stands on something sinks into it when lowered
    lowered[id].p[2] -= static_cast<std::int32_t>(std::lround(1e6 * (kMaxStartGap + 0.001)));
    checker.set_state(lowered);
    bool carried = false;
    for (const auto& [a, b] : checker.overlapping_objects(0.0005)) carried = carried || a == id || b == id;
    if (!carried) return invalid(problem, "object '" + scene[id].id + "' floats at the start: nothing is under it");
  }
  checker.set_state(start);
  return {};
}

Status check_goal(const Problem& problem, const ForwardKinematics& kinematics) {
  const Eigen::Isometry3d* X_WT = nullptr;
  if (const auto* reach = std::get_if<ReachPose>(&problem.task)) X_WT = &reach->X_WT;
  if (const auto* retrieve = std::get_if<Retrieve>(&problem.task)) X_WT = &retrieve->X_WT_pregrasp;
  if (!X_WT) return {};
  IkOptions options;
  options.starts *= 4;  // a refusal should be sure of itself
  if (InverseKinematics(kinematics).solve(*X_WT, problem.q_start, 1, options)) return {};
  return invalid(problem, "the goal pose of '" + problem.robot.model->links[problem.robot.group.tip.index()].name +
                              "' has no inverse-kinematics solution within the joint limits (" +
                              std::to_string(options.starts) + " starts tried)");
}

}  // namespace

Status validate(const Problem& problem) {
  auto kinematics = std::make_shared<ForwardKinematics>(problem.robot);
  CollisionChecker checker(kinematics, problem.scene);
  if (Status s = check_start(problem, checker); !s) return s;
  if (Status s = check_objects(problem, checker); !s) return s;
  return check_goal(problem, *kinematics);
}

}  // namespace mamo
