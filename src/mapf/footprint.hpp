// An object as the path finding sees it: at its present orientation and height, it may be anywhere in x and y.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mapf/planar_shape.hpp"

#include "mamo/model/scene.hpp"

namespace mamo::mapf {

/// A shape from above, and what of the height it takes up. Exact for upright boxes and cylinders and for spheres at the
/// height of their centre; else an upper bound: the shadow, all the way up.
struct Prism {
  PlanarShape shadow;  // about the object's origin (m)
  double low, high;    // m, world z
};

struct Footprint {
  std::vector<Prism> prisms;
  double reach = 0;  // m, from the origin
  double low = 0;    // m, world z of the lowest point
};

/// Of the object at X_WO; only the orientation and the height of X_WO matter.
Footprint footprint_of(const Object& object, const Eigen::Isometry3d& X_WO);

/// Bodies that share less height than this do not collide: what stands on something sinks in a little (m).
inline constexpr double kLeastCommonHeight = kMaxPenetration;

/// The heights that both take up, as (low, high) in `common`; false if that is too little to matter.
bool common_height(const Prism& a, const Prism& b, Eigen::Vector2d& common);

/// Where the second body's origin, relative to the first one's, may not be: shapes whose union it is. None if the
/// two are at different heights.
std::vector<PlanarShape> obstacle_shapes(const Footprint& still, const Footprint& moving);

/// Least signed distance (m); infinite of none.
double signed_distance(const std::vector<PlanarShape>& shapes, const Eigen::Vector2d& p);

}  // namespace mamo::mapf
