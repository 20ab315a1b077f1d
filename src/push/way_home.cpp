#include "push/way_home.hpp"

#include <algorithm>
#include <cmath>

#include "mamo/lattice/joint_path.hpp"

namespace mamo::push {
namespace {

constexpr double kStep = 0.03;         // m of the tip between two configurations when drawn out
constexpr double kAngleWeight = 0.05;  // m per rad
constexpr int kEdgeEvery = 2;          // steps between two attempts at the straight edge home
constexpr double kDetour = 0.2;        // m

}  // namespace

WayHome::WayHome(const Problem& problem, const ForwardKinematics& kinematics, const PushBodies& bodies,
                 CollisionChecker& checker)
    : problem_(problem),
      kinematics_(kinematics),
      bodies_(bodies),
      checker_(checker),
      follower_(kinematics),
      X_WT_rest_(kinematics.tip_pose(problem.q_start)) {
  p_shoulder_ = kinematics.link_pose(problem.q_start, problem.robot.joint(0).child).translation().head<2>();
}

bool WayHome::free(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return checker_.check_edge(a, b, bodies_.forbidden, bodies_.movable, report_) && report_.touched.empty();
}

bool WayHome::free(const std::vector<Eigen::VectorXd>& path) {
  for (std::size_t k = 1; k < path.size(); ++k)
    if (!free(path[k - 1], path[k])) return false;
  return true;
}

std::vector<Eigen::VectorXd> WayHome::quick(const Eigen::VectorXd& q) {
  if (free(q, problem_.q_start)) return {q, problem_.q_start};
  const Eigen::Isometry3d X_WT = kinematics_.tip_pose(q);
  const Eigen::Vector2d radial = (p_shoulder_ - X_WT.translation().head<2>()).normalized();
  const Eigen::Vector2d axis = X_WT.linear().col(0).head<2>();
  const Eigen::Vector3d detours[] = {Eigen::Vector3d::Zero(), kDetour * Eigen::Vector3d(-axis.x(), -axis.y(), 0),
                                     kDetour * Eigen::Vector3d(radial.x(), radial.y(), 0),
                                     Eigen::Vector3d(kDetour * radial.x(), kDetour * radial.y(), 0.25 * kDetour)};
  for (const Eigen::Vector3d& detour : detours)
    if (std::vector<Eigen::VectorXd> path = drawn_out(q, detour); !path.empty()) return path;
  return {};
}

std::vector<Eigen::VectorXd> WayHome::drawn_out(const Eigen::VectorXd& q, const Eigen::Vector3d& detour) {
  const Eigen::Isometry3d X_WT = kinematics_.tip_pose(q);
  const Eigen::Vector3d via = X_WT.translation() + detour;
  const double first = detour.norm(), second = (X_WT_rest_.translation() - via).norm();
  const int steps = static_cast<int>(std::ceil((first + second) / kStep));
  const Eigen::Quaterniond R(X_WT.linear()), R_rest(X_WT_rest_.linear());
  std::vector<Eigen::VectorXd> path = {q};
  for (int k = 1; k <= steps; ++k) {
    const double along = (first + second) * k / steps;
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    if (along < first) {
      target.translation() = X_WT.translation() + detour * (along / first);
      target.linear() = X_WT.linear();
    } else {
      const double s = second > 0 ? (along - first) / second : 1;
      target.translation() = via + (X_WT_rest_.translation() - via) * s;
      target.linear() = R.slerp(s, R_rest).toRotationMatrix();
    }
    Eigen::VectorXd next = path.back();
    if (follower_.step(target, kAngleWeight, next) != Follow::reached || !free(path.back(), next)) return {};
    path.push_back(next);
    if (k % kEdgeEvery && k < steps) continue;
    if (!free(next, problem_.q_start)) continue;
    path.push_back(problem_.q_start);
    shorten(path);
    return path;
  }
  return {};
}

/// Greedy halving: points that are not needed go.
void WayHome::shorten(std::vector<Eigen::VectorXd>& path) {
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    std::size_t ahead = path.size() - 1 - i;
    for (; ahead > 1; ahead /= 2)
      if (free(path[i], path[i + ahead])) break;
    if (ahead > 1)
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                 path.begin() + static_cast<std::ptrdiff_t>(i + ahead));
  }
}

std::vector<Eigen::VectorXd> WayHome::search(const Eigen::VectorXd& q, RandomStream random, int nodes,
                                             StopSource* stop) {
  if (nodes <= 0) return {};
  const JointPathQuery query{q, {problem_.q_start}, bodies_.forbidden, bodies_.movable, {}};
  JointPathOptions options;
  options.max_nodes = nodes;
  options.shortcuts = 20;
  options.direct = false;
  return find_joint_path(problem_.robot, checker_, query, random, options, stop);
}

}  // namespace mamo::push
