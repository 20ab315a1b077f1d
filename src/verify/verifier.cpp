#include "mamo/verify/verifier.hpp"

#include <algorithm>
#include <limits>

#include "verify/arm_check.hpp"
#include "verify/finding.hpp"
#include "verify/outcome_checks.hpp"
#include "verify/plan_checks.hpp"
#include "verify/replay.hpp"
#include "verify/timeline.hpp"

namespace mamo {
namespace {

using namespace verify;

/// Where the arm first hits itself or a static body it may not touch.
std::optional<Verdict::Finding> check_arm(const Problem& problem, const Plan& plan, const Timeline& line, ArmCheck& arm,
                                          StopSource& stop) {
  const TimedPath& path = line.path;
  for (std::size_t k = 0; k < path.q.size(); ++k) {
    if (stop.stopped()) return std::nullopt;
    const std::size_t from = k > 0 ? k - 1 : 0;
    if (k == 0 && path.q.size() > 1) continue;  // the first piece includes the first point
    const std::optional<ArmHit> hit = arm.along(path.q[from], path.q[k]);
    if (!hit) continue;
    const double time_s = path.t[from] + hit->fraction * (path.t[k] - path.t[from]);
    const std::vector<Link>& links = problem.robot.model->links;
    const std::string link = links[hit->link.index()].name;
    Violation v{ViolationKind::robot_touch, hit->body, kRobot, 0, 0, time_s};
    std::string detail = "link " + link;
    if (hit->other_link.valid()) {
      v = {ViolationKind::self_collision, kRobot, kNoObject, 0, 0, time_s};
      detail = "links " + link + " and " + links[hit->other_link.index()].name;
    }
    return make_finding(problem.scene, plan, line.segment_at(time_s), v, detail);
  }
  return std::nullopt;
}

}  // namespace

Verdict Verifier::judge(const Problem& problem, const Plan& plan, StopSource& stop) const {
  return run(problem, plan, stop, nullptr);
}

Verdict Verifier::judge(const Problem& problem, const Plan& plan, StopSource& stop, Recording& recording) const {
  recording = {};
  return run(problem, plan, stop, &recording);
}

Verdict Verifier::run(const Problem& problem, const Plan& plan, StopSource& stop, Recording* recording) const {
  Verdict verdict;
  verdict.findings = check_form(problem, plan);
  if (verdict.findings.empty()) verdict.findings = check_joints(problem, plan);
  if (!verdict.findings.empty()) return verdict;

  const auto kinematics = std::make_shared<const ForwardKinematics>(problem.robot);
  const Timeline line = make_timeline(problem, plan);
  ArmCheck arm(problem, *kinematics, options_.arm_step);
  const std::optional<Verdict::Finding> arm_hit = check_arm(problem, plan, line, arm, stop);
  const double until_s = arm_hit ? arm_hit->violation.time_s : std::numeric_limits<double>::infinity();
  ReplayOutcome outcome = replay(problem, plan, line, kinematics, arm, until_s, stop, recording);
  if (outcome.stopped || stop.stopped()) {
    verdict = {};
    verdict.stopped = true;
    return verdict;
  }
  verdict.interactions = std::move(outcome.interactions);
  verdict.findings = check_objects(problem, plan, line, outcome.objects_after, options_.object_tolerance);
  if (outcome.violation)
    verdict.findings.push_back(make_finding(problem.scene, plan, outcome.segment, *outcome.violation, outcome.detail));
  else if (arm_hit)
    verdict.findings.push_back(*arm_hit);
  else if (std::optional<Verdict::Finding> undone = check_task(problem, plan, line, *kinematics, outcome.holding))
    verdict.findings.push_back(*undone);
  std::stable_sort(verdict.findings.begin(), verdict.findings.end(),
                   [](const auto& a, const auto& b) { return a.violation.time_s < b.violation.time_s; });
  verdict.objects_after = std::move(outcome.objects_after);
  verdict.ok = verdict.findings.empty();
  return verdict;
}

}  // namespace mamo
