#include "mamo/kinematics/inverse_kinematics.hpp"

#include <numbers>

#include "mamo/common/random.hpp"

namespace mamo {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::uint64_t kStreamKey = 0x696b;  // "ik"
constexpr double kLargestStep = 0.8;          // rad or m, of any joint in one iteration
constexpr double kAngleWeight = 0.3;          // m per rad, about the arm's lever: balances the two halves of the error

/// Rotation vector (world axes, rad) that turns `from` into `to`, at most pi long.
Eigen::Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::Matrix3d R = to * from.transpose();
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = 0.5 * twice_sine.norm(), cosine = 0.5 * (R.trace() - 1.0);
  if (cosine < -0.99) {  // near pi the sine says little about the axis
    const Eigen::AngleAxisd turn(R);
    return turn.angle() * turn.axis();
  }
  const double angle = std::atan2(sine, cosine);
  return twice_sine * (sine > 1e-9 ? 0.5 * angle / sine : 0.5);
}

/// The iteration of one start. Levenberg-Marquardt on the six weighted errors; a joint that stands at a limit and is
/// pushed out of it is left out of the step (projected descent), so that limits shorten no other joint's motion.
class Descent {
 public:
  Descent(const ForwardKinematics& kinematics, const Eigen::Isometry3d& X_WT, const IkOptions& options)
      : kinematics_(kinematics), robot_(kinematics.robot()), X_WT_(X_WT), options_(options) {
    J_.resize(6, robot_.dof());
    free_.resize(robot_.dof());
  }

  /// Moves q towards the target. True when it is there.
  bool run(Eigen::VectorXd& q) {
    double damping = 1e-3;
    Vector6d error = error_at(q);
    for (int iteration = 0; iteration < options_.iterations_per_start; ++iteration) {
      if (reached(error)) return true;
      kinematics_.jacobian(X_WL_, J_);
      J_.bottomRows<3>() *= kAngleWeight;
      gradient_.noalias() = J_.transpose() * error;
      const double before = error.squaredNorm();
      bool better = false;
      for (int attempt = 0; attempt < 4 && !better; ++attempt) {
        step(q, error, damping);
        const Vector6d next_error = error_at(next_);
        better = next_error.squaredNorm() < before;
        if (better) {
          q.swap(next_);
          error = next_error;
        }
        damping = better ? std::max(damping * 0.1, 1e-9) : damping * 10.0;
      }
      // No descent at any damping, or hardly any: a local minimum. The next start is worth more than going on.
      if (!better || error.squaredNorm() > before * (1.0 - 1e-3)) return reached(error);
    }
    return reached(error);
  }

 private:
  bool reached(const Vector6d& error) const {
    return error.head<3>().norm() <= options_.position_tolerance &&
           error.tail<3>().norm() <= kAngleWeight * options_.angle_tolerance;
  }

  /// Leaves the poses of q in X_WL_.
  Vector6d error_at(const Eigen::VectorXd& q) {
    kinematics_.chain_poses(q, X_WL_);
    const Eigen::Isometry3d& X = X_WL_[robot_.group.tip.index()];
    Vector6d error;
    error.head<3>() = X_WT_.translation() - X.translation();
    error.tail<3>() = kAngleWeight * rotation_between(X.linear(), X_WT_.linear());
    return error;
  }

  /// next_ = q + J^T (J J^T + damping I)^-1 error over the free joints, clamped into the limits.
  void step(const Eigen::VectorXd& q, const Vector6d& error, double damping) {
    Matrix6d A = damping * Matrix6d::Identity();
    for (int i = 0; i < robot_.dof(); ++i) {
      const Joint& j = robot_.joint(i);
      free_[i] = !((q[i] >= j.upper && gradient_[i] > 0) || (q[i] <= j.lower && gradient_[i] < 0));
      if (free_[i]) A.noalias() += J_.col(i) * J_.col(i).transpose();
    }
    const Vector6d y = A.ldlt().solve(error);
    next_ = q;
    double largest = 0;
    for (int i = 0; i < robot_.dof(); ++i) {
      if (free_[i]) next_[i] += J_.col(i).dot(y);
      largest = std::max(largest, std::abs(next_[i] - q[i]));
    }
    if (largest > kLargestStep) next_ = q + (kLargestStep / largest) * (next_ - q);
    for (int i = 0; i < robot_.dof(); ++i)
      next_[i] = std::clamp(next_[i], robot_.joint(i).lower, robot_.joint(i).upper);
  }

  const ForwardKinematics& kinematics_;
  const Robot& robot_;
  const Eigen::Isometry3d& X_WT_;
  const IkOptions& options_;
  std::vector<Eigen::Isometry3d> X_WL_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_;
  Eigen::VectorXd gradient_, next_;
  Eigen::Matrix<bool, Eigen::Dynamic, 1> free_;
};

/// The seed itself (clamped) for attempt 0, then a draw within the limits; continuous joints around the seed.
Eigen::VectorXd start_of_attempt(const Robot& robot, const Eigen::VectorXd& seed_q, std::uint64_t seed, int attempt) {
  RandomStream random(seed, {kStreamKey, static_cast<std::uint64_t>(attempt)});
  Eigen::VectorXd q = seed_q;
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& j = robot.joint(i);
    const double lower = std::isfinite(j.lower) ? j.lower : seed_q[i] - std::numbers::pi;
    const double upper = std::isfinite(j.upper) ? j.upper : seed_q[i] + std::numbers::pi;
    q[i] = attempt == 0 ? std::clamp(seed_q[i], j.lower, j.upper) : random.uniform(lower, upper);
  }
  return q;
}

/// Continuous joints by whole turns to within pi of the seed.
void unwind(const Robot& robot, const Eigen::VectorXd& seed_q, Eigen::VectorXd& q) {
  for (int i = 0; i < robot.dof(); ++i)
    if (robot.joint(i).type == JointType::continuous)
      q[i] = seed_q[i] + std::remainder(q[i] - seed_q[i], 2.0 * std::numbers::pi);
}

/// Largest joint difference (rad or m), continuous joints the short way round.
double separation(const Robot& robot, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double largest = 0;
  for (int i = 0; i < robot.dof(); ++i) {
    const double d = a[i] - b[i];
    const bool wraps = robot.joint(i).type == JointType::continuous;
    largest = std::max(largest, std::abs(wraps ? std::remainder(d, 2.0 * std::numbers::pi) : d));
  }
  return largest;
}

}  // namespace

std::optional<Eigen::VectorXd> InverseKinematics::solve(const Eigen::Isometry3d& X_WT, const Eigen::VectorXd& seed_q,
                                                        std::uint64_t seed, const IkOptions& options) const {
  std::vector<Eigen::VectorXd> found = solve_many(X_WT, seed_q, seed, 1, options);
  if (found.empty()) return std::nullopt;
  return std::move(found.front());
}

std::vector<Eigen::VectorXd> InverseKinematics::solve_many(
    const Eigen::Isometry3d& X_WT, const Eigen::VectorXd& seed_q, std::uint64_t seed, int count,
    const IkOptions& options, const std::function<bool(const Eigen::VectorXd&)>& accept) const {
  const Robot& robot = kinematics_.robot();
  std::vector<Eigen::VectorXd> found;
  Descent descent(kinematics_, X_WT, options);
  for (int attempt = 0; attempt < options.starts && static_cast<int>(found.size()) < count; ++attempt) {
    Eigen::VectorXd q = start_of_attempt(robot, seed_q, seed, attempt);
    if (!descent.run(q)) continue;
    unwind(robot, seed_q, q);
    const auto is_near = [&](const Eigen::VectorXd& other) {
      return separation(robot, q, other) < options.min_separation;
    };
    if (std::none_of(found.begin(), found.end(), is_near) && (!accept || accept(q))) found.push_back(std::move(q));
  }
  return found;
}

std::pair<double, double> pose_error(const Eigen::Isometry3d& A, const Eigen::Isometry3d& B) {
  return {(A.translation() - B.translation()).norm(), rotation_between(A.linear(), B.linear()).norm()};
}

}  // namespace mamo
