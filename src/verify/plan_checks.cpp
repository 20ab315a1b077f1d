#include "verify/plan_checks.hpp"

#include <cmath>
#include <set>

#include "verify/finding.hpp"
#include "verify/timeline.hpp"

namespace mamo::verify {
namespace {

constexpr double kVelocitySlack = 1e-6;  // relative
constexpr double kTimeSlack = 1e-9;      // s

/// Empty, or what is wrong with the names and numbers of one segment.
std::string form_of_motion(const Robot& robot, const Segment& segment) {
  const std::vector<int> indices = group_indices(robot, segment);
  std::set<int> seen;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0) return "joint '" + segment.joint_names[i] + "' is none of the planning group";
    if (!seen.insert(indices[i]).second) return "joint '" + segment.joint_names[i] + "' is named twice";
  }
  const TimedPath& motion = segment.motion;
  if (motion.t.empty() || motion.q.empty()) return "no points";
  if (motion.t.size() != motion.q.size()) return "not one time per point";
  for (std::size_t k = 0; k < motion.t.size(); ++k) {
    const std::string point = "point " + std::to_string(k);
    if (!std::isfinite(motion.t[k])) return point + " has a time that is no number";
    if (motion.q[k].size() != static_cast<Eigen::Index>(segment.joint_names.size()))
      return point + " has " + std::to_string(motion.q[k].size()) + " values for " +
             std::to_string(segment.joint_names.size()) + " joints";
    if (!motion.q[k].allFinite()) return point + " has a value that is no number";
    if (k == 0 && std::abs(motion.t[0]) > kTimeSlack) return "times do not start at 0";
    if (k > 0 && motion.t[k] <= motion.t[k - 1]) return point + " is not later than the point before";
  }
  return {};
}

std::string form_of_objects(const Scene& scene, const Segment& segment) {
  if (segment.object != kNoObject && (!segment.object.valid() || segment.object.index() >= scene.size()))
    return "the segment is about an object that is not in the scene";
  for (const auto& [id, X_WO] : segment.objects_after) {
    if (!id.valid() || id.index() >= scene.size()) return "objects_after names an object that is not in the scene";
    if (scene[id].fixture()) return "objects_after names the fixture " + scene[id].id;
    if (!X_WO.matrix().allFinite()) return "objects_after has a pose of " + scene[id].id + " that is no number";
  }
  return {};
}

/// A retrieval grasps once, and what was asked for.
std::string form_of_grasp(const Problem& problem, const Plan& plan, std::size_t s) {
  const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task);
  const Segment& segment = plan.segments[s];
  if (!retrieve || segment.kind != SegmentKind::grasp) return {};
  if (static_cast<int>(s) != grasp_segment(problem, plan)) return "a second grasp";
  if (segment.object != kNoObject && segment.object != retrieve->object)
    return "grasps " + name_of(problem.scene, segment.object) + ", asked for was " +
           name_of(problem.scene, retrieve->object);
  return {};
}

/// The worst value of one kind in one segment.
struct Worst {
  ViolationKind kind;
  double excess = 0;  // value over limit; reported if positive
  Violation violation;
  std::string joint;

  void offer(double value, double limit, double time_s, const std::string& name) {
    const double over = std::abs(value) - limit;
    if (!(over > excess)) return;
    excess = over;
    violation.kind = kind;
    violation.value = std::abs(value);
    violation.limit = limit;
    violation.time_s = time_s;
    joint = name;
  }
};

}  // namespace

int grasp_segment(const Problem& problem, const Plan& plan) {
  if (!std::holds_alternative<Retrieve>(problem.task)) return -1;
  for (std::size_t s = 0; s < plan.segments.size(); ++s)
    if (plan.segments[s].kind == SegmentKind::grasp) return static_cast<int>(s);
  return -1;
}

std::vector<Verdict::Finding> check_form(const Problem& problem, const Plan& plan) {
  std::vector<Verdict::Finding> findings;
  const auto report = [&](int segment, const std::string& detail) {
    Violation v;
    v.kind = ViolationKind::malformed_plan;
    findings.push_back(make_finding(problem.scene, plan, segment, v, detail));
  };
  if (plan.empty()) report(0, "the plan has no segments");
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    std::string wrong = form_of_motion(problem.robot, plan.segments[s]);
    if (wrong.empty()) wrong = form_of_objects(problem.scene, plan.segments[s]);
    if (wrong.empty()) wrong = form_of_grasp(problem, plan, s);
    if (!wrong.empty()) report(static_cast<int>(s), wrong);
  }
  return findings;
}

std::vector<Verdict::Finding> check_joints(const Problem& problem, const Plan& plan) {
  std::vector<Verdict::Finding> findings;
  const Robot& robot = problem.robot;
  Eigen::VectorXd q = problem.q_start;
  double offset = 0;
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    const Segment& segment = plan.segments[s];
    const TimedPath& motion = segment.motion;
    const std::vector<int> indices = group_indices(robot, segment);
    Worst jump{s == 0 ? ViolationKind::wrong_start : ViolationKind::discontinuity, 0, {}, {}};
    Worst limit{ViolationKind::joint_limit, 0, {}, {}}, velocity{ViolationKind::joint_velocity, 0, {}, {}};
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const Joint& joint = robot.joint(indices[i]);
      const auto value = [&](std::size_t k) { return motion.q[k][static_cast<Eigen::Index>(i)]; };
      jump.offer(value(0) - q[indices[i]], kSameValue, offset, joint.name);
      for (std::size_t k = 0; k < motion.t.size(); ++k) {
        const double time_s = offset + motion.t[k];
        // Between two points the motion is linear: the points decide. Signed values read better than distances.
        if (value(k) > joint.upper + kSameValue || value(k) < joint.lower - kSameValue) {
          const double bound = value(k) > joint.upper ? joint.upper : joint.lower;
          if (std::abs(value(k) - bound) > limit.excess) {
            limit.excess = std::abs(value(k) - bound);
            limit.violation = {limit.kind, kNoObject, kNoObject, value(k), bound, time_s};
            limit.joint = joint.name;
          }
        }
        if (k > 0)
          velocity.offer((value(k) - value(k - 1)) / (motion.t[k] - motion.t[k - 1]),
                         joint.max_velocity * robot.speed_scale * (1 + kVelocitySlack), time_s, joint.name);
      }
      q[indices[i]] = value(motion.t.size() - 1);
    }
    for (const Worst* worst : {&jump, &limit, &velocity})
      if (worst->excess > 0)
        findings.push_back(
            make_finding(problem.scene, plan, static_cast<int>(s), worst->violation, "joint " + worst->joint));
    offset += motion.duration();
  }
  return findings;
}

}  // namespace mamo::verify
