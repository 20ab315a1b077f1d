// The arm while its tip moves along a straight line, in one posture: no jump between solutions.
#pragma once

#include <vector>

#include "mamo/kinematics/inverse_kinematics.hpp"

namespace mamo::retrieval {

/// Configurations from q (where the tip is at X_WT) on, the tip moved by `shift` (world, m) without turning, one every
/// `step` metres and one at the end. Ends early where there is no continuous solution inside the limits.
std::vector<Eigen::VectorXd> follow_line(const InverseKinematics& ik, const Eigen::VectorXd& q,
                                         const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& shift, double step);

/// Number of configurations of a complete line.
std::size_t line_points(const Eigen::Vector3d& shift, double step);

}  // namespace mamo::retrieval
