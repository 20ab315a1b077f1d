// What moves rigidly with the tip, as a cloud of points of its surfaces: a test that needs no inverse kinematics.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo::push {

/// Immutable after construction.
class Gripper {
 public:
  explicit Gripper(const ForwardKinematics& kinematics);

  /// Is a point of the gripper inside one of the objects when the tip is at X_WT? True means that there is a
  /// collision for certain.
  bool surely_hits(const Scene& scene, const WorldState& state, const ObjectSet& against,
                   const Eigen::Isometry3d& X_WT) const;

  /// How far the gripper reaches beyond its tip along the unit vector d_W, looking only at points whose distance from
  /// the line through the tip is at most `half_width` across (horizontally). Not negative. m
  double reach(const Eigen::Matrix3d& R_WT, const Eigen::Vector3d& d_W, double half_width) const;

  const std::vector<Eigen::Vector3d>& points() const { return p_TQ_; }  // in the tip's frame

 private:
  std::vector<Eigen::Vector3d> p_TQ_;
};

}  // namespace mamo::push
