// Where every link is for a configuration of the group joints, and the Jacobian of the tip.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/model/robot.hpp"

namespace mamo {

/// Precomputes the chain of a robot. Immutable after construction: one instance serves every thread.
/// Links that no group joint moves are computed once; only moving links cost time.
class ForwardKinematics {
 public:
  explicit ForwardKinematics(const Robot& robot);

  /// Poses of all links in world for a configuration (dof values). `X_WL` is the caller's scratch, resized
  /// to the number of links and overwritten; entries of still links are written only when the size changes.
  void link_poses(const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) const;
  /// The same for the links between the root and the tip only; the entries of other moving links are left as they are.
  void chain_poses(const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL) const;

  /// Pose of the tip link (or of `link`) in world.
  Eigen::Isometry3d tip_pose(const Eigen::VectorXd& q) const;
  Eigen::Isometry3d link_pose(const Eigen::VectorXd& q, LinkId link) const;

  /// Geometric Jacobian of the tip link origin in world axes, 6 x dof: rows 0-2 linear, 3-5 angular.
  void jacobian(const Eigen::VectorXd& q, Eigen::Matrix<double, 6, Eigen::Dynamic>& J) const;
  /// The same from poses that chain_poses() or link_poses() wrote; no allocation when J has its size.
  void jacobian(const std::vector<Eigen::Isometry3d>& X_WL, Eigen::Matrix<double, 6, Eigen::Dynamic>& J) const;

  /// For each group joint, an upper bound on how far any collision point of the moving links (resp. a point
  /// p_L of `link`) travels per unit of that joint, in any configuration (m/rad, or 1 for prismatic).
  Eigen::VectorXd motion_bounds() const;
  Eigen::VectorXd motion_bounds(LinkId link, const Eigen::Vector3d& p_L) const;

  const Robot& robot() const { return robot_; }

 private:
  enum class Motion { none, about_x, about_y, about_z, about_axis, along_axis };
  struct Step {  // one moving link: X_WL[link] = X_WL[parent] * X_PJ * motion(value)
    int link, parent;
    Eigen::Isometry3d X_PJ;
    bool rotated;  // X_PJ has a rotation
    Eigen::Vector3d axis;
    Motion motion;
    int group_index;  // -1: constant
    double multiplier, offset;
  };
  struct ChainJoint {  // a joint between root and tip that moves the tip
    int link;          // its child, whose frame holds the axis
    int group_index;
    double multiplier;
    bool prismatic;
    Eigen::Vector3d axis;
  };
  static void take(const Step& step, const Eigen::VectorXd& q, std::vector<Eigen::Isometry3d>& X_WL);

  Robot robot_;
  std::vector<Eigen::Isometry3d> rest_;  // poses at the posture
  std::vector<Step> steps_, tip_steps_;  // all moving links; those between root and tip
  std::vector<ChainJoint> chain_;
};

}  // namespace mamo
