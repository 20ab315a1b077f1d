#include "view/outline.hpp"

#include <cmath>
#include <numbers>

namespace mamo::view {

Points2 outline(const Shape& shape, const Eigen::Isometry3d& X_WS) {
  // The farthest points in directions once around are the outline's corners in order. Directions are a little off
  // the axes, so that a box's edge is never perpendicular to one.
  constexpr int kDirections = 48;
  Points2 corners;
  for (int k = 0; k < kDirections; ++k) {
    const double a = 2 * std::numbers::pi * k / kDirections + 1e-4;
    const Eigen::Vector3d d = X_WS.linear().transpose() * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
    const Eigen::Vector2d p = (X_WS * support(shape, d)).head<2>();
    if (corners.empty() || (p - corners.back()).norm() > 1e-6) corners.push_back(p);
  }
  while (corners.size() > 1 && (corners.front() - corners.back()).norm() <= 1e-6) corners.pop_back();
  return corners;
}

}  // namespace mamo::view
