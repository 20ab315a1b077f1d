// Convex shapes of the plane with rounded corners: what bodies look like from above, and the sums of such.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace mamo::mapf {

/// All points within `radius` of the convex hull of some points: a disc, a stadium, a polygon (radius 0), or a rounded
/// polygon, which is what Minkowski sums of those are. Immutable.
class PlanarShape {
 public:
  /// points: at least one, in any order.
  PlanarShape(std::vector<Eigen::Vector2d> points, double radius);

  /// Metres from p to the boundary, negative inside. Exact.
  double signed_distance(const Eigen::Vector2d& p) const;
  /// Hull vertices, counter-clockwise.
  const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  double radius() const { return radius_; }
  /// The farthest point from the origin is this far away.
  double reach() const;
  Eigen::Vector2d lower() const;
  Eigen::Vector2d upper() const;

 private:
  struct Edge {
    Eigen::Vector2d from, direction, normal;  // unit vectors; normal to the outside
    double length;
  };
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<Edge> edges_;  // none of a point, one of a segment
  double radius_;
};

/// { a - b }: q + b meets a (b placed at q) if and only if q is in it.
PlanarShape minkowski_difference(const PlanarShape& a, const PlanarShape& b);

/// A point well inside of both shapes, a placed at p_a, b at p_b; false if none was found (they hardly meet).
bool common_point(const PlanarShape& a, const Eigen::Vector2d& p_a, const PlanarShape& b, const Eigen::Vector2d& p_b,
                  Eigen::Vector2d& out);

}  // namespace mamo::mapf
