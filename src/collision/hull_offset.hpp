// Convex hulls grown or shrunk by a distance.
#pragma once

#include <vector>

#include "mamo/model/shape.hpp"

namespace mamo::collision {

/// Points whose hull holds everything within `distance` (m) of the given one; for a negative distance points inside
/// it, at least that deep under every face where the hull is thick enough, else towards the centroid.
std::vector<Eigen::Vector3d> offset_vertices(const ConvexHull& hull, double distance);

}  // namespace mamo::collision
