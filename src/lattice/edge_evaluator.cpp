#include "mamo/lattice/edge_evaluator.hpp"

namespace mamo {

ObjectId target_of(const Task& task) {
  const auto* reach = std::get_if<ReachPose>(&task);
  return reach ? reach->target : kNoObject;
}

RelevantBodies make_relevant_bodies(const Problem& problem, const ObjectSet& relevant) {
  const Scene& scene = problem.scene;
  const ObjectId target = target_of(problem.task);
  RelevantBodies bodies{relevant, ObjectSet(scene.size()), ObjectSet(scene.size())};
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const ObjectId id(i);
    const Object& object = scene[id];
    if (!object.fixture() && !relevant.contains(id)) continue;
    const bool may_touch = id != target && robot_may_touch(object.constraints.touch);
    // A fixture that the robot may touch stops nothing and is pushed by nothing: it does not count.
    if (!may_touch)
      bodies.forbidden.insert(id);
    else if (!object.fixture())
      bodies.watched.insert(id);
  }
  return bodies;
}

EdgeEvaluator::EdgeEvaluator(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                             const CollisionOptions& collision)
    : problem_(problem),
      target_(target_of(problem.task)),
      collision_(kinematics, problem.scene, collision),
      physics_(kinematics, problem.scene) {}

EdgeResult EdgeEvaluator::evaluate(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const RelevantBodies& bodies,
                                   const WorldState& from, StopSource* stop, const std::atomic<bool>* cancel) {
  EdgeResult result;
  collision_.set_state(from);
  if (!collision_.check_edge(q0, q1, bodies.forbidden, bodies.watched, report_)) {
    Violation violation;
    violation.kind = report_.self ? ViolationKind::self_collision : ViolationKind::robot_touch;
    violation.other = kRobot;
    if (!report_.self)
      for (ObjectId id : report_.touched)
        if (bodies.forbidden.contains(id)) violation.object = id;
    result.violation = violation;
    return result;
  }
  if (report_.touched.empty()) {
    result.valid = true;
    result.state = from;
    return result;
  }
  result.simulated = true;
  result.motion = time_path(problem_.robot, {q0, q1}, problem_.scene.physics.step);
  EvaluationRequest request;
  request.present = &bodies.relevant;
  request.from = &from;
  request.motion = &result.motion;
  request.untouchable = target_;
  request.stop = stop;
  request.cancel = cancel;
  Evaluation evaluation = physics_.evaluate(request);
  result.cancelled = evaluation.cancelled;
  result.valid = evaluation.valid && !evaluation.cancelled;
  result.state = std::move(evaluation.state);
  result.settle_s = evaluation.settle_s;
  result.interactions = std::move(evaluation.interactions);
  result.second_order = evaluation.second_order;
  result.violation = evaluation.violation;
  return result;
}

}  // namespace mamo
