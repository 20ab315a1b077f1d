// What one rigid body looks like to Bullet: its collision shape and its inertia.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "mamo/model/shape.hpp"

class btCollisionShape;

namespace mamo {

/// Immutable. Frame B is the link's or object's own; frame C sits at the centre of mass along the principal
/// axes, which is what Bullet simulates. One primitive becomes itself, several shapes a compound.
class BodyShape {
 public:
  explicit BodyShape(const std::vector<PlacedShape>& shapes);
  ~BodyShape();

  btCollisionShape* bullet() const;                          // in frame C
  const Eigen::Isometry3d& X_BC() const;
  /// Diagonal of the inertia in C (kg m^2).
  Eigen::Vector3d inertia(double mass) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mamo
