// Convex hulls made in code.
#pragma once

#include <memory>
#include <numbers>

#include "mamo/model/shape.hpp"

namespace mamo::fixtures {

/// An ellipsoid of `rings` by `sectors` facets with half axes `half` around `centre` (m).
inline std::shared_ptr<ConvexHull> ellipsoid_hull(const Eigen::Vector3d& half, const Eigen::Vector3d& centre, int rings,
                                                  int sectors) {
  auto hull = std::make_shared<ConvexHull>();
  const auto point = [&](double polar, double azimuth) {
    const Eigen::Vector3d unit(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                               std::cos(polar));
    return Eigen::Vector3d(centre + half.cwiseProduct(unit));
  };
  hull->vertices.push_back(point(0, 0));
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < sectors; ++s)
      hull->vertices.push_back(point(std::numbers::pi * r / rings, 2 * std::numbers::pi * s / sectors));
  hull->vertices.push_back(centre - Eigen::Vector3d(0, 0, half.z()));
  const int last = static_cast<int>(hull->vertices.size()) - 1;
  const auto at = [&](int ring, int sector) { return 1 + (ring - 1) * sectors + sector % sectors; };
  for (int s = 0; s < sectors; ++s) {
    hull->triangles.push_back({0, at(1, s), at(1, s + 1)});
    hull->triangles.push_back({last, at(rings - 1, s + 1), at(rings - 1, s)});
    for (int r = 1; r + 1 < rings; ++r) {
      hull->triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      hull->triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
  }
  hull->centroid = centre;
  hull->volume = 4.0 / 3.0 * std::numbers::pi * half.prod();
  return hull;
}

/// A box as a hull.
inline std::shared_ptr<ConvexHull> box_hull(const Eigen::Vector3d& half, const Eigen::Vector3d& centre) {
  auto hull = std::make_shared<ConvexHull>();
  for (int c = 0; c < 8; ++c)
    hull->vertices.push_back(centre +
                             half.cwiseProduct(Eigen::Vector3d(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)));
  hull->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  hull->centroid = centre;
  hull->volume = 8 * half.prod();
  return hull;
}

}  // namespace mamo::fixtures
