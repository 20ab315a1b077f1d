// Volume, centre and inertia of shapes of uniform density.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mamo/model/shape.hpp"

namespace mamo {

/// Of a body of density 1.
struct MassProperties {
  double volume = 0;                                    // m^3
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();     // centre of mass (m)
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();    // about the centre, axes of the frame (m^5)
};

/// In the shape's frame.
MassProperties mass_properties(const Shape& shape);
/// Of several shapes as one body, in the body's frame. Overlaps count twice.
MassProperties mass_properties(const std::vector<PlacedShape>& shapes);

}  // namespace mamo
