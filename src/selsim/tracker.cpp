#include "mamo/selsim/tracker.hpp"

namespace mamo {
namespace {

/// Appends a motion (and a wait) to a timed path, in whole steps so that times do not drift.
void append(TimedPath& path, const TimedPath& motion, double settle_s, double step_s) {
  const long offset = std::lround(path.t.back() / step_s);
  for (std::size_t k = 1; k < motion.t.size(); ++k) {
    path.t.push_back(static_cast<double>(offset + std::lround(motion.t[k] / step_s)) * step_s);
    path.q.push_back(motion.q[k]);
  }
  const long wait = std::lround(settle_s / step_s);
  if (wait <= 0) return;
  path.t.push_back(static_cast<double>(std::lround(path.t.back() / step_s) + wait) * step_s);
  path.q.push_back(path.q.back());
}

}  // namespace

Track track(const Problem& problem, EdgeEvaluator& evaluator, const std::vector<Eigen::VectorXd>& path,
            const RelevantBodies& bodies, StopSource* stop) {
  const double step_s = problem.scene.physics.step;
  Track out;
  out.state = WorldState::start_of(problem.scene);
  out.states.push_back(out.state);
  out.motion.t = {0.0};
  out.motion.q = {path.front()};
  out.edge_of_point = {-1};
  for (std::size_t k = 1; k < path.size(); ++k) {
    EdgeResult edge = evaluator.evaluate(path[k - 1], path[k], bodies, out.state, stop, nullptr);
    out.simulations += evaluator.counts(edge, bodies, out.state);
    if (edge.cancelled) {
      out.stopped = true;
      return out;
    }
    const double start_s = out.motion.duration();
    for (Interaction i : edge.interactions) {
      i.first_time_s += start_s;
      out.interactions.push_back(i);
    }
    out.second_order = out.second_order || edge.second_order;
    if (!edge.valid) {
      out.failed_edge = static_cast<int>(k) - 1;
      out.violation = edge.violation;
      return out;
    }
    if (edge.motion.t.empty()) edge.motion = time_path(problem.robot, {path[k - 1], path[k]}, step_s);
    append(out.motion, edge.motion, edge.settle_s, step_s);
    out.edge_of_point.resize(out.motion.t.size(), static_cast<int>(k) - 1);
    out.state = std::move(edge.state);
    out.touching.push_back(edge.simulated);
    out.states.push_back(out.state);
  }
  out.ok = true;
  return out;
}

}  // namespace mamo
