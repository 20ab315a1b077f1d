#include "retrieval/grasp_poses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mamo::retrieval {
namespace {

constexpr double kDeepest = 0.025;      // m, tip beyond the object's centre (the published grasp)
constexpr double kFingerDepth = 0.075;  // m, what fits between tip and palm: the tip goes no deeper below the surface
constexpr double kShallowest = 0.03;    // m below the surface: less is no grip
constexpr double kDepthStep = 0.02, kHeightStep = 0.03;  // m
constexpr double kRim = 0.02;                            // m, tip from the object's top and bottom
constexpr double kYawStep = std::numbers::pi / 12;
constexpr int kYawSteps = 5, kHeightSteps = 2, kDepthSteps = 3;  // to each side; depths in all
constexpr double kHeightCost = 1.2, kDepthCost = 1.5;            // of a step, where a step of yaw costs 1

/// Of the object's shapes at X_WO along a direction in world, from a point (m).
double extent(const Object& object, const Eigen::Isometry3d& X_WO, const Eigen::Vector3d& p_W,
              const Eigen::Vector3d& direction) {
  double most = -1e9;
  for (const PlacedShape& s : object.shapes) {
    const Eigen::Isometry3d X_WS = X_WO * s.X_BS;
    const Eigen::Vector3d p = X_WS * support(s.shape, X_WS.linear().transpose() * direction);
    most = std::max(most, direction.dot(p - p_W));
  }
  return most;
}

struct Variation {
  int yaw, height, depth;
  double cost() const { return std::abs(yaw) + kHeightCost * std::abs(height) + kDepthCost * depth; }
};

std::vector<Variation> variations(bool level) {
  std::vector<Variation> all;
  for (int yaw = -kYawSteps; yaw <= kYawSteps; ++yaw)
    for (int height = level ? -kHeightSteps : 0; height <= (level ? kHeightSteps : 0); ++height)
      for (int depth = 0; depth < kDepthSteps; ++depth) all.push_back({yaw, height, depth});
  std::stable_sort(all.begin(), all.end(), [](const Variation& a, const Variation& b) { return a.cost() < b.cost(); });
  return all;
}

}  // namespace

std::vector<GraspPose> grasp_poses(const Object& object, const Eigen::Isometry3d& X_WT_pregrasp, int count) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d centre = object.X_WO * object.centre_of_mass();
  const double top = extent(object, object.X_WO, centre, up), bottom = -extent(object, object.X_WO, centre, -up);
  const Eigen::Vector3d away = centre - X_WT_pregrasp.translation();
  const bool level = away.head<2>().norm() > std::abs(away.z());
  const Eigen::Vector3d ahead =
      level ? Eigen::Vector3d(away.x(), away.y(), 0).normalized() : Eigen::Vector3d(0, 0, away.z() < 0 ? -1 : 1);
  const double distance = away.dot(ahead);

  std::vector<GraspPose> poses;
  for (const Variation& v : variations(level)) {
    if (static_cast<int>(poses.size()) >= count) break;
    const Eigen::Matrix3d R = Eigen::AngleAxisd(v.yaw * kYawStep, up).toRotationMatrix();
    const Eigen::Vector3d direction = R * ahead;
    const double surface = extent(object, object.X_WO, centre, -direction);  // from the centre, towards the robot
    const double deepest = std::min(kDeepest, kFingerDepth - surface);
    const double depth = deepest - v.depth * kDepthStep;
    if (v.depth > 0 && depth < kShallowest - surface) continue;
    Eigen::Isometry3d X = X_WT_pregrasp;
    X.linear() = R * X.linear();
    X.translation() = centre + R * (X.translation() - centre);
    if (level && v.height != 0) {
      X.translation().z() += v.height * kHeightStep;
      const double height = X.translation().z() - centre.z();
      if (height < bottom + kRim || height > top - kRim) continue;
    }
    GraspPose pose{X, X, direction};
    pose.X_WT.translation() += (distance + depth) * direction;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace mamo::retrieval
