// Where the tip closes on an object: variations of the grasp that a given pre-grasp pose leads to.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/model/scene.hpp"

namespace mamo::retrieval {

struct GraspPose {
  Eigen::Isometry3d X_WT_pregrasp;
  Eigen::Isometry3d X_WT;              // the pre-grasp pose moved along `direction`
  Eigen::Vector3d direction{1, 0, 0};  // of the approach, unit, in world
};

/// At most `count` poses, the one closest to the given pre-grasp first. The approach is level (straight down where the
/// pre-grasp is above the object) and aims at the object's centre. Yaw turns it about the vertical through the
/// object's centre; height shifts it along the object; depth is how far the tip goes in.
std::vector<GraspPose> grasp_poses(const Object& object, const Eigen::Isometry3d& X_WT_pregrasp, int count);

}  // namespace mamo::retrieval
