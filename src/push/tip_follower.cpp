#include "push/tip_follower.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::push {
namespace {

constexpr double kPositionTolerance = 1e-3;  // m
constexpr double kDamping = 1e-4;            // m^2
constexpr double kLargestStep = 0.15;        // rad or m, of a joint in one iteration
constexpr double kLargestTurn = 0.5;  // rad or m, of a joint from one target to the next: more is another posture
constexpr int kIterations = 12;

}  // namespace

TipFollower::TipFollower(const ForwardKinematics& kinematics) : kinematics_(kinematics), robot_(kinematics.robot()) {
  J_.resize(6, robot_.dof());
  kinematics_.link_poses(robot_.group_part(robot_.posture), X_WL_);
}

Follow TipFollower::step(const Eigen::Isometry3d& X_WT, double angle_weight, Eigen::VectorXd& q) {
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  const Eigen::VectorXd q0 = q;
  bool at_limit = false;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    kinematics_.chain_poses(q, X_WL_);
    const Eigen::Isometry3d& X = X_WL_[robot_.group.tip.index()];
    const Eigen::AngleAxisd turn(X_WT.linear() * X.linear().transpose());
    Vector6d error;
    error.head<3>() = X_WT.translation() - X.translation();
    error.tail<3>() = angle_weight * turn.angle() * turn.axis();
    const bool there = error.head<3>().norm() <= kPositionTolerance;
    if (there && (iteration > 0 || error.tail<3>().norm() <= kPositionTolerance)) {
      return (q - q0).cwiseAbs().maxCoeff() <= kLargestTurn ? Follow::reached : Follow::unreachable;
    }
    kinematics_.jacobian(X_WL_, J_);
    J_.bottomRows<3>() *= angle_weight;
    const Eigen::VectorXd gradient = J_.transpose() * error;
    Matrix6d A = kDamping * Matrix6d::Identity();
    const auto blocked = [&](int i) {
      const Joint& j = robot_.joint(i);
      return (q[i] >= j.upper && gradient[i] > 0) || (q[i] <= j.lower && gradient[i] < 0);
    };
    for (int i = 0; i < robot_.dof(); ++i) {
      if (blocked(i)) {
        at_limit = true;
        continue;
      }
      A.noalias() += J_.col(i) * J_.col(i).transpose();
    }
    const Vector6d y = A.ldlt().solve(error);
    Eigen::VectorXd dq = Eigen::VectorXd::Zero(robot_.dof());
    for (int i = 0; i < robot_.dof(); ++i)
      if (!blocked(i)) dq[i] = J_.col(i).dot(y);
    const double largest = dq.cwiseAbs().maxCoeff();
    if (largest > kLargestStep) dq *= kLargestStep / largest;
    for (int i = 0; i < robot_.dof(); ++i)
      q[i] = std::clamp(q[i] + dq[i], robot_.joint(i).lower, robot_.joint(i).upper);
  }
  return at_limit ? Follow::joint_limit : Follow::unreachable;
}

}  // namespace mamo::push
