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
};

/// Immutable after construction.
class PushSampler {
 public:
  PushSampler(const Problem& problem, const ForwardKinematics& kinematics, const PushOptions& options);

  /// Draws from `random`.
  TipWay sample(const PushRequest& request, RandomStream& random) const;

  /// Is the tip at the start of the way inside or within a centimetre of one of these objects?
  bool start_inside(const TipWay& way, const WorldState& state, const ObjectSet& against) const;
  const Gripper& gripper() const { return gripper_; }

 private:
  /// How far the object reaches from its origin along the horizontal unit vector d (m).
  double extent(const PushRequest& request, const Eigen::Vector3d& d) const;
  double bottom(const PushRequest& request) const;  // z of its lowest point

  const Scene& scene_;
  const PushOptions options_;
  const Gripper gripper_;
  Eigen::Vector2d p_shoulder_;  // in plan view: the arm points away from it (m)
};

}  // namespace mamo::push
