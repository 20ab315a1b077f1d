// Where the tip starts and which way it goes to push an object along a path (E-M4M, Figure 4), drawn at random.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "push/gripper.hpp"

#include "mamo/common/random.hpp"
#include "mamo/push/push_planner.hpp"

namespace mamo::push {

/// The way of the tip in one push.
struct TipWay {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  // at the start
  std::vector<Eigen::Vector3d> points;                     // of the tip, the start first; straight between
  double free_length = 0;                                  // m of it before the gripper reaches the object
};

/// How far from the usual a draw may be. `wide` also has steep and rolled grippers and starts far behind the object,
/// from where what stands between is pushed along.
enum class Spread { common, wide };

/// Immutable after construction.
class PushSampler {
 public:
  PushSampler(const Problem& problem, const ForwardKinematics& kinematics, const PushOptions& options);

  /// Draws from `random`. The path's points must not all be the same.
  TipWay sample(const PushRequest& request, Spread spread, RandomStream& random) const;

  /// For certain a collision at the start of the way: the tip is in or within a centimetre of one of these objects, or
  /// another point of the gripper is inside. No kinematics needed.
  bool start_inside(const TipWay& way, const WorldState& state, const ObjectSet& against) const;

 private:
  Eigen::Matrix3d orientation(const Eigen::Vector2d& p, double push_yaw, Spread spread, RandomStream& random) const;
  /// How far the object reaches from its origin along the unit vector d (m).
  double extent(const PushRequest& request, const Eigen::Vector3d& d) const;

  const Scene& scene_;
  const PushOptions options_;
  const Gripper gripper_;
  Eigen::Vector2d p_shoulder_;  // in plan view: the arm points away from it (m)
};

}  // namespace mamo::push
