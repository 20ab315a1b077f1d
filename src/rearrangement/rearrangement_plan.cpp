#include "mamo/rearrangement/rearrangement_plan.hpp"

#include <cmath>

namespace mamo {
namespace {

Segment segment(const Problem& problem, SegmentKind kind, ObjectId object, const std::vector<Eigen::VectorXd>& path,
                double wait_s) {
  Segment out;
  out.kind = kind;
  out.object = object;
  for (int i = 0; i < problem.robot.dof(); ++i) out.joint_names.push_back(problem.robot.joint(i).name);
  const double step_s = problem.scene.physics.step;
  out.motion = time_path(problem.robot, path, step_s);
  const long steps = std::lround(wait_s / step_s);
  if (steps > 0) {
    out.motion.t.push_back(static_cast<double>(std::lround(out.motion.t.back() / step_s) + steps) * step_s);
    out.motion.q.push_back(out.motion.q.back());
  }
  return out;
}

}  // namespace

Plan rearrangement_plan(const Problem& problem, const std::vector<std::pair<ObjectId, const PushOutcome*>>& pushes,
                        const RetrievalPath& retrieval) {
  Plan plan;
  for (const auto& [object, push] : pushes) {
    plan.segments.push_back(segment(problem, SegmentKind::approach, object, push->approach, 0));
    plan.segments.push_back(segment(problem, SegmentKind::push, object, push->push, push->settle_s));
    plan.segments.push_back(segment(problem, SegmentKind::retreat, object, push->retreat, 0));
  }
  const ObjectId target = std::get<Retrieve>(problem.task).object;
  plan.segments.push_back(segment(problem, SegmentKind::approach, target, retrieval.approach, 0));
  plan.segments.push_back(segment(problem, SegmentKind::grasp, target, retrieval.reach, 0));
  plan.segments.push_back(segment(problem, SegmentKind::extract, target, retrieval.extract, 0));
  return plan;
}

}  // namespace mamo
