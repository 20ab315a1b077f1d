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

std::shared_ptr<OutcomeMemo> EdgeEvaluator::make_memo() const {
  return std::make_shared<OutcomeMemo>(problem_.scene, physics_);
}

bool EdgeEvaluator::counts(const EdgeResult& result, const RelevantBodies& bodies, const WorldState& from) const {
  if (!result.simulated || !memo_ || !result.motion_simulated) return result.simulated;
  return memo_->charged(*result.motion_simulated, bodies.relevant, from);
}

Glance EdgeEvaluator::glance(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const RelevantBodies& bodies,
                             const WorldState& from, std::optional<Violation>& violation) {
  collision_.set_state(from);
  if (collision_.check_edge(q0, q1, bodies.forbidden, bodies.watched, report_))
    return report_.touched.empty() ? Glance::free : Glance::touching;
  violation.emplace();
  violation->kind = report_.self ? ViolationKind::self_collision : ViolationKind::robot_touch;
  violation->other = kRobot;
  if (!report_.self)
    for (ObjectId id : report_.touched)
      if (bodies.forbidden.contains(id)) violation->object = id;
  return Glance::blocked;
}

EdgeResult EdgeEvaluator::evaluate(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const RelevantBodies& bodies,
                                   const WorldState& from, StopSource* stop, const std::atomic<bool>* cancel) {
  EdgeResult result;
  const Glance seen = glance(q0, q1, bodies, from, result.violation);
  if (seen == Glance::blocked) return result;
  result.state = from;
  if (seen == Glance::free) {
    result.valid = true;
    return result;
  }
  result.simulated = true;
  result.motion = time_path(problem_.robot, {q0, q1}, problem_.scene.physics.step);
  std::shared_ptr<const SimulatedMotion> known;
  if (memo_) known = memo_->find(q0, q1, bodies.relevant, from);
  if (!known) {
    auto fresh = std::make_shared<SimulatedMotion>();
    EvaluationRequest request;
    request.present = &bodies.relevant;
    request.from = &from;
    request.motion = &result.motion;
    request.untouchable = target_;
    request.stop = stop;
    request.cancel = cancel;
    *fresh = {q0, q1, bodies.relevant, from, physics_.evaluate(request)};
    if (memo_ && !fresh->outcome.cancelled) memo_->insert(fresh);
    known = std::move(fresh);
  }
  const Evaluation& outcome = known->outcome;
  result.cancelled = outcome.cancelled;
  result.valid = outcome.valid && !outcome.cancelled;
  for (ObjectId id : bodies.relevant.ids())
    if (outcome.took_part.contains(id)) result.state[id] = outcome.state[id];
  result.settle_s = outcome.settle_s;
  result.interactions = outcome.interactions;
  result.second_order = outcome.second_order;
  result.violation = outcome.violation;
  if (!result.cancelled) result.motion_simulated = std::move(known);
  return result;
}

}  // namespace mamo
