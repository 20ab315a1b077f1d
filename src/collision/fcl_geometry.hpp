// The one door to FCL: shapes as FCL geometries, and whether two of them intersect.
#pragma once

#include <Eigen/Geometry>

#include <memory>

#include "mamo/model/shape.hpp"

namespace fcl {
template <typename S>
class CollisionGeometry;
}

namespace mamo::collision {

using Geometry = std::shared_ptr<const fcl::CollisionGeometry<double>>;

/// The shape grown by `padding` (m, may be negative). Primitives keep their kind (a box grows by the padding on every
/// side); a hull grows to a polytope that holds every point within `padding` of it. Immutable, shared by threads.
Geometry make_geometry(const Shape& shape, double padding = 0);

/// Boolean narrow phase (libccd); touching may count either way.
bool intersect(const fcl::CollisionGeometry<double>& a, const Eigen::Isometry3d& X_WA,
               const fcl::CollisionGeometry<double>& b, const Eigen::Isometry3d& X_WB);

}  // namespace mamo::collision
