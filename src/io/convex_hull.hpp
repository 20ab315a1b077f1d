// Convex hulls of point sets, and hulls with fewer vertices that still contain them.
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <vector>

#include "mamo/model/shape.hpp"

namespace mamo::io {

/// The hull of the points: closed triangles seen counter-clockwise from outside, volume and centroid. Bullet's hull
/// computes on an integer grid of 1e-4 of the extent in each axis, so a vertex lies up to half of that beside its
/// point (the extremes in x, y and z stay where they are). None when the points span no volume or are not finite.
std::optional<ConvexHull> convex_hull(const std::vector<Eigen::Vector3d>& points);

struct SimplifyOptions {
  int max_vertices = 64;     // contact detection pays per vertex
  int last_resort = 96;      // allowed where max_vertices would cost more than max_growth
  double tolerance = 2e-4;   // m: fewer vertices are enough when nothing sticks out further
  double max_growth = 1e-3;  // m
};
struct SimplifiedHull {
  ConvexHull hull;
  double growth = 0;  // m: how far its surface lies outside the original at most; 0 when nothing was changed
};
/// A hull of few vertices that contains the given one (to 1e-6 m and the grid of convex_hull): the vertices that stick
/// out most are taken one after the other, then all are moved outward along their normals until nothing sticks out.
/// Deterministic. A hull that is small already comes back unchanged. `growth` may exceed max_growth: the caller says
/// so.
SimplifiedHull simplify(const ConvexHull& hull, const SimplifyOptions& options = {});

}  // namespace mamo::io
