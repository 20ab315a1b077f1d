// A retrieval among clutter, built in code, and pushes to ask for.
#pragma once

#include <numbers>
#include <vector>

#include "support/fixtures.hpp"

#include "mamo/push/push_planner.hpp"

namespace mamo::fixtures {

/// What profile `full` asks of a movable object.
inline void constrain(Object& object) {
  if (!object.movable()) return;
  object.constraints.max_tilt = 25 * std::numbers::pi / 180;
  object.constraints.max_speed = 1.0;
  object.constraints.may_leave_support = false;
}

/// The PR2-like arm before the shelf; the first immovable object is to be retrieved.
inline Problem push_problem(Scene scene) {
  Problem problem;
  problem.robot = pr2_like_arm();
  problem.q_start = problem.robot.posture;
  for (Object& object : scene.objects) constrain(object);
  problem.scene = std::move(scene);
  problem.profile = Profile::full;
  Retrieve task;
  task.home = problem.q_start;
  for (const ObjectId id : ObjectSet::of_kind(problem.scene, ObjectKind::immovable).ids())
    if (!task.object.valid()) task.object = id;
  problem.task = task;
  return problem;
}

/// One cylinder in the middle of the front half; an immovable object out of the way.
inline Problem one_cylinder_problem() {
  Scene scene = shelf();
  scene.objects.push_back(standing_cylinder("can", 0.65, -0.4, 0.04, 0.15));
  scene.objects.push_back(standing_cylinder("target", 0.95, -0.2, 0.04, 0.15, ObjectKind::immovable));
  return push_problem(std::move(scene));
}

inline PushRequest straight_push(const Problem& problem, ObjectId object, double heading, double length,
                                 int attempt = 0) {
  const Eigen::Vector2d p = problem.scene[object].X_WO.translation().head<2>();
  PushRequest request;
  request.object = object;
  request.path = {p, p + length * Eigen::Vector2d(std::cos(heading), std::sin(heading))};
  request.state = WorldState::start_of(problem.scene);
  request.attempt = attempt;
  return request;
}

/// Of every movable object in the front half of the shelf: backwards, oblique and sideways.
inline std::vector<PushRequest> push_requests(const Problem& problem) {
  std::vector<PushRequest> requests;
  for (const ObjectId id : ObjectSet::of_kind(problem.scene, ObjectKind::movable).ids()) {
    if (problem.scene[id].X_WO.translation().x() > 0.8) continue;
    for (const double heading : {0.0, 0.7, -0.7, 1.4, -1.4})
      requests.push_back(straight_push(problem, id, heading, 0.1));
  }
  return requests;
}

}  // namespace mamo::fixtures
