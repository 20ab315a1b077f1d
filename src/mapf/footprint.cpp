#include "mapf/footprint.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A polygon about the shadow of any shape: the lines that support it in some directions, cut with each other.
PlanarShape circumscribed(const Shape& shape, const Eigen::Isometry3d& X) {
  constexpr int kDirections = 24;
  // Starts along the projected axis, so that the ends of a lying cylinder are flat.
  const Vector3d axis = X.linear().col(2);
  const double first = std::atan2(axis.y(), axis.x());
  std::vector<Vector2d> normals;
  std::vector<double> offsets;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = first + 2 * std::numbers::pi * k / kDirections;
    const Vector3d n(std::cos(angle), std::sin(angle), 0);
    normals.push_back(n.head<2>());
    offsets.push_back(n.dot(X * support(shape, X.linear().transpose() * n)));
  }
  std::vector<Vector2d> corners;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const std::size_t next = (k + 1) % normals.size();
    Eigen::Matrix2d lines;
    lines << normals[k].transpose(), normals[next].transpose();
    corners.push_back(lines.inverse() * Vector2d(offsets[k], offsets[next]));
  }
  return {std::move(corners), 0.0};
}

PlanarShape shadow_of_points(const std::vector<Vector3d>& points, const Eigen::Isometry3d& X) {
  std::vector<Vector2d> shadow;
  for (const Vector3d& p : points) shadow.push_back((X * p).head<2>());
  return {std::move(shadow), 0.0};
}

PlanarShape shadow_of(const Shape& shape, const Eigen::Isometry3d& X) {
  if (const auto* box = std::get_if<Box>(&shape)) {
    std::vector<Vector3d> corners;
    for (int k = 0; k < 8; ++k)
      corners.push_back(box->size.cwiseProduct(Vector3d((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2 & 1) - 0.5)));
    return shadow_of_points(corners, X);
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    constexpr double kUpright = 0.1;  // sine of the tilt up to which two discs, one per end, bound the shadow well
    const Vector2d axis = X.linear().col(2).head<2>();
    if (axis.norm() > kUpright) return circumscribed(shape, X);
    const Vector2d centre = X.translation().head<2>(), half = axis * (cylinder->length / 2);
    return {{centre - half, centre + half}, cylinder->radius};
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {{X.translation().head<2>()}, sphere->radius};
  return shadow_of_points(std::get<Mesh>(shape).hull->vertices, X);
}

}  // namespace

Footprint footprint_of(const Object& object, const Eigen::Isometry3d& X_WO) {
  Eigen::Isometry3d X = X_WO;
  X.translation().head<2>().setZero();
  Footprint out;
  out.low = std::numeric_limits<double>::infinity();
  for (const PlacedShape& placed : object.shapes) {
    const Eigen::Isometry3d X_S = X * placed.X_BS;
    const Eigen::AlignedBox3d box = bounds(placed.shape, X_S);
    out.prisms.push_back({shadow_of(placed.shape, X_S), box.min().z(), box.max().z()});
    out.reach = std::max(out.reach, out.prisms.back().shadow.reach());
    out.low = std::min(out.low, box.min().z());
  }
  return out;
}

bool common_height(const Prism& a, const Prism& b, Vector2d& common) {
  common = {std::max(a.low, b.low), std::min(a.high, b.high)};
  return common[1] - common[0] > kLeastCommonHeight;
}

std::vector<PlanarShape> obstacle_shapes(const Footprint& still, const Footprint& moving) {
  std::vector<PlanarShape> out;
  Vector2d common;
  for (const Prism& s : still.prisms)
    for (const Prism& m : moving.prisms)
      if (common_height(s, m, common)) out.push_back(minkowski_difference(s.shadow, m.shadow));
  return out;
}

double signed_distance(const std::vector<PlanarShape>& shapes, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlanarShape& s : shapes) least = std::min(least, s.signed_distance(p));
  return least;
}

}  // namespace mamo::mapf
