// What a shape covers seen from above.
#pragma once

#include "mamo/model/shape.hpp"
#include "mamo/view/svg.hpp"

namespace mamo::view {

/// Convex, counter-clockwise, in world metres. Exact for boxes, 48 corners for round shapes.
Points2 outline(const Shape& shape, const Eigen::Isometry3d& X_WS);

}  // namespace mamo::view
