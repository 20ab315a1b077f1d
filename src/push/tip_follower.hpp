// Differential inverse kinematics: the tip along a line, its orientation as far as joints allow.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo::push {

enum class Follow { reached, joint_limit, unreachable };

/// Holds scratch; answers depend on the arguments only.
class TipFollower {
 public:
  explicit TipFollower(const ForwardKinematics& kinematics);

  /// Moves q, by damped least squares, to where the tip's position is that of X_WT within a millimetre. The orientation
  /// counts `angle_weight` metres per radian and may be missed. Else q is somewhere between.
  Follow step(const Eigen::Isometry3d& X_WT, double angle_weight, Eigen::VectorXd& q);

 private:
  const ForwardKinematics& kinematics_;
  const Robot& robot_;
  std::vector<Eigen::Isometry3d> X_WL_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_;
};

}  // namespace mamo::push
