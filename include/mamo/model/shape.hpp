// Collision shapes of links and objects: convex primitives, sizes in metres, frames at the centre.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace mamo {

struct Box {
  Eigen::Vector3d size;  // full sizes along x, y, z (m)
};
struct Cylinder {
  double radius;  // m
  double length;  // full length along z (m)
};
struct Sphere {
  double radius;  // m
};
/// A closed convex polytope, counter-clockwise triangles seen from outside. Made by io from a mesh file.
struct ConvexHull {
  std::vector<Eigen::Vector3d> vertices;      // in the shape's frame (m), scale applied
  std::vector<std::array<int, 3>> triangles;  // indices into vertices
  double volume = 0;                          // m^3
  Eigen::Vector3d centroid{0, 0, 0};          // of the solid (m)
  std::string source;                         // path of the mesh, for messages and for export
  Eigen::Vector3d scale{1, 1, 1};             // as given with the source
};
/// A mesh collides as its convex hull. Shared: geometry is immutable and used by every worker.
struct Mesh {
  std::shared_ptr<const ConvexHull> hull;
};

using Shape = std::variant<Box, Cylinder, Sphere, Mesh>;

/// A shape placed in the frame of its link or object.
struct PlacedShape {
  Shape shape;
  Eigen::Isometry3d X_BS = Eigen::Isometry3d::Identity();  // shape in body
};

/// m^3.
double volume(const Shape& shape);
/// Axis-aligned bounds of the shape placed at X.
Eigen::AlignedBox3d bounds(const Shape& shape, const Eigen::Isometry3d& X);
/// Farthest point of the shape in a direction, both in the shape's frame. The zero vector gives any point.
Eigen::Vector3d support(const Shape& shape, const Eigen::Vector3d& direction);
/// Signed distance (m, negative inside) from a point in the shape's frame. Exact for the primitives; for a
/// mesh the largest plane distance: exact inside, a lower bound outside.
double signed_distance(const Shape& shape, const Eigen::Vector3d& point);
/// "cylinder r 0.033 l 0.101", for messages.
std::string describe(const Shape& shape);

}  // namespace mamo
