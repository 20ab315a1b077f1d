// Outlines of upright things seen from above, and how far apart they are.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/model/shape.hpp"

namespace mamo {

/// Convex polygon, counter-clockwise (m). Circles become polygons around them.
using Footprint = std::vector<Eigen::Vector2d>;

Footprint footprint(const Shape& shape, double x, double y, double yaw);

/// Do the outlines come closer than `gap`? Exact for gap 0; else separated along one of their edge normals, which
/// asks for a little more than `gap` where two corners meet.
bool closer_than(const Footprint& a, const Footprint& b, double gap);

}  // namespace mamo
