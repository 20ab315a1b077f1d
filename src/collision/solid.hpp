// Convex solids as the checker sees them: an FCL geometry with cheap bounds in front of it.
#pragma once

#include <Eigen/Geometry>

#include "fcl_geometry.hpp"

namespace mamo::collision {

/// Where a solid's frame is in the world.
struct Placed {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
};

/// A convex shape in a frame at the centre of its bounding box. Immutable after make_solid.
struct Solid {
  enum class Kind { box, cylinder, sphere, hull };
  Kind kind = Kind::box;
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  // half sizes of the bounding box; cylinder: (r, r, l/2) (m)
  double radius = 0;                               // of the ball around the centre that holds the solid (m)
  Geometry geometry;                               // for FCL, in the same frame
};

/// The shape grown by `padding` (m, may be negative, see make_geometry). `centre` receives the origin of the solid's
/// frame in the shape's frame; the axes are the same.
Solid make_solid(const Shape& shape, double padding, Eigen::Vector3d& centre);

/// Half the width of the solid (of its box for a hull) along a unit vector of the world (m).
inline double half_width(const Solid& s, const Eigen::Matrix3d& R, const Eigen::Vector3d& d) {
  switch (s.kind) {
    case Solid::Kind::sphere:
      return s.half.x();
    case Solid::Kind::cylinder: {
      const double z = R.col(2).dot(d);
      return s.half.x() * std::sqrt(std::max(0.0, 1.0 - z * z)) + s.half.z() * std::abs(z);
    }
    default:
      return s.half.x() * std::abs(R.col(0).dot(d)) + s.half.y() * std::abs(R.col(1).dot(d)) +
             s.half.z() * std::abs(R.col(2).dot(d));
  }
}

/// Half sizes of the axis-aligned world box around the solid (m).
inline Eigen::Vector3d half_box(const Solid& s, const Eigen::Matrix3d& R) {
  switch (s.kind) {
    case Solid::Kind::sphere:
      return s.half;
    case Solid::Kind::cylinder: {
      const Eigen::Array3d z = R.col(2).array();
      return (s.half.x() * (1.0 - z * z).max(0.0).sqrt() + s.half.z() * z.abs()).matrix();
    }
    default:
      return R.cwiseAbs() * s.half;
  }
}

/// apart: no point of one comes within `clearance` of the other (proven by a plane or a closed form).
/// near: they do not intersect. hit: they do.
enum class Relation { apart, near, hit };

/// The relation of two placed solids; FCL is asked when nothing cheaper can tell.
Relation relate(const Solid& a, const Placed& X_WA, const Solid& b, const Placed& X_WB, double clearance);

}  // namespace mamo::collision
