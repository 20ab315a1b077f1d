#include "verify/outcome_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "verify/finding.hpp"

namespace mamo::verify {
namespace {

constexpr double kSlack = 1e-9;  // rounding of the last operation

std::string degrees_text(double angle_rad) {
  char text[64];
  std::snprintf(text, sizeof text, "turned by %.3g rad, limit %.3g rad", angle_rad, kTurnTolerance);
  return text;
}

double angle_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  return Eigen::AngleAxisd(A.transpose() * B).angle();
}

std::optional<Violation> joints_goal(const Robot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& goal,
                                     double tolerance, std::string& detail) {
  Violation worst{ViolationKind::task_not_done, kNoObject, kNoObject, 0, tolerance, 0};
  for (int i = 0; i < robot.dof(); ++i) {
    double off = std::abs(q[i] - goal[i]);
    if (robot.joint(i).type == JointType::continuous) off = std::abs(std::remainder(off, 2 * std::numbers::pi));
    if (!(off > tolerance + kSlack) || off <= worst.value) continue;
    worst.value = off;
    detail = "rad, joint " + robot.joint(i).name;
  }
  return worst.value > 0 ? std::optional(worst) : std::nullopt;
}

}  // namespace

std::vector<Verdict::Finding> check_objects(const Problem& problem, const Plan& plan, const Timeline& line,
                                            const std::vector<std::map<ObjectId, Eigen::Isometry3d>>& measured,
                                            double tolerance) {
  std::vector<Verdict::Finding> findings;
  for (std::size_t s = 0; s < measured.size() && findings.empty(); ++s) {
    for (const auto& [id, predicted] : plan.segments[s].objects_after) {
      const Eigen::Isometry3d& seen = measured[s].at(id);
      const double off = (predicted.translation() - seen.translation()).norm();
      const double turned = angle_between(predicted.linear(), seen.linear());
      if (off <= tolerance && turned <= kTurnTolerance) continue;
      const Violation v{ViolationKind::objects_mismatch, id, kNoObject, off, tolerance, line.end_s[s]};
      findings.push_back(make_finding(problem.scene, plan, static_cast<int>(s), v,
                                      turned > kTurnTolerance ? degrees_text(turned) : "objects_after"));
    }
  }
  return findings;
}

std::optional<Verdict::Finding> check_task(const Problem& problem, const Plan& plan, const Timeline& line,
                                           const ForwardKinematics& kinematics, bool holding) {
  const Eigen::VectorXd& q = line.path.q.back();
  std::optional<Violation> wrong;
  std::string detail;
  if (const ReachPose* reach = std::get_if<ReachPose>(&problem.task)) {
    const Eigen::Isometry3d X_WT = kinematics.tip_pose(q);
    const double off = (X_WT.translation() - reach->X_WT.translation()).norm();
    const double turned = angle_between(X_WT.linear(), reach->X_WT.linear());
    const Violation v{ViolationKind::task_not_done, kNoObject, kNoObject, 0, 0, 0};
    if (!(off <= reach->position_tolerance + kSlack)) {
      wrong = v, detail = "m, position of the tip";
      wrong->value = off, wrong->limit = reach->position_tolerance;
    } else if (!(turned <= reach->angle_tolerance + kSlack)) {
      wrong = v, detail = "rad, angle of the tip";
      wrong->value = turned, wrong->limit = reach->angle_tolerance;
    }
  } else if (const ReachJoints* joints = std::get_if<ReachJoints>(&problem.task)) {
    wrong = joints_goal(problem.robot, q, joints->q, joints->tolerance, detail);
  } else if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) {
    wrong = joints_goal(problem.robot, q, retrieve->home, retrieve->home_tolerance, detail);
    if (!holding) {
      wrong = Violation{ViolationKind::task_not_done, retrieve->object, kNoObject, 0, 0, 0};
      detail = "the object is not held at the end: the plan has no grasp segment";
    }
  }
  if (!wrong) return std::nullopt;
  wrong->time_s = line.duration_s();
  return make_finding(problem.scene, plan, static_cast<int>(plan.segments.size()) - 1, *wrong, detail);
}

}  // namespace mamo::verify
