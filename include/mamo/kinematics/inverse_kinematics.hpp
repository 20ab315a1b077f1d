// Configurations that put the tip link at a pose: damped least squares with seeded restarts.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo {

struct IkOptions {
  double position_tolerance = 1e-4;  // m
  double angle_tolerance = 1e-3;     // rad
  int iterations_per_start = 60;     // damped least-squares steps from one start
  int starts = 30;                   // the given seed first, then draws from the stream
  double min_separation = 0.3;       // rad: solutions closer than this (max norm) count as one
};

/// Immutable after construction; one instance serves every thread. No clock: budgets are counts.
class InverseKinematics {
 public:
  explicit InverseKinematics(const ForwardKinematics& kinematics) : kinematics_(kinematics) {}

  /// One solution inside the joint limits, starting at `seed_q`, restarting from a stream keyed by
  /// (seed, attempt). Continuous joints come back within pi of seed_q.
  std::optional<Eigen::VectorXd> solve(const Eigen::Isometry3d& X_WT, const Eigen::VectorXd& seed_q, std::uint64_t seed,
                                       const IkOptions& options = {}) const;

  /// Up to `count` distinct solutions for which `accept` holds (pass {} for all), in order of discovery.
  std::vector<Eigen::VectorXd> solve_many(const Eigen::Isometry3d& X_WT, const Eigen::VectorXd& seed_q,
                                          std::uint64_t seed, int count, const IkOptions& options = {},
                                          const std::function<bool(const Eigen::VectorXd&)>& accept = {}) const;

 private:
  const ForwardKinematics& kinematics_;
};

/// Norm of the position error (m) and angle of the relative rotation (rad) between two poses.
std::pair<double, double> pose_error(const Eigen::Isometry3d& A, const Eigen::Isometry3d& B);

}  // namespace mamo
