#include "mapf/planar_shape.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Counter-clockwise, without points on edges (Andrew's monotone chain).
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  constexpr double kSame = 1e-9;  // m
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector2d> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.empty() ? 0 : hull.size() - 1;  // the last of one chain is the first of the next
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0)
        hull.pop_back();
      if (hull.empty() || (*it - hull.back()).norm() > kSame) hull.push_back(*it);
    }
  };
  chain(points.begin(), points.end());
  if (hull.size() == 1) return hull;
  chain(std::next(points.rbegin()), points.rend());
  if ((hull.front() - hull.back()).norm() <= kSame) hull.pop_back();
  return hull;
}

/// Corners of a polygon inside the shape and close to it.
std::vector<Vector2d> inner_polygon(const PlanarShape& shape, const Vector2d& p) {
  constexpr int kCorners = 12;
  std::vector<Vector2d> points;
  for (const Vector2d& v : shape.vertices())
    if (shape.radius() > 0)
      for (int k = 0; k < kCorners; ++k) {
        const double angle = 2 * std::numbers::pi * k / kCorners;
        points.push_back(p + v + shape.radius() * Vector2d(std::cos(angle), std::sin(angle)));
      }
    else
      points.push_back(p + v);
  return convex_hull(std::move(points));
}

/// What of the polygon lies to the left of a -> b.
std::vector<Vector2d> clip(const std::vector<Vector2d>& polygon, const Vector2d& a, const Vector2d& b) {
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = cross(b - a, p - a), at_q = cross(b - a, q - a);
    if (at_p >= 0) out.push_back(p);
    if ((at_p >= 0) != (at_q >= 0)) out.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return out;
}

}  // namespace

PlanarShape::PlanarShape(std::vector<Vector2d> points, double radius)
    : vertices_(convex_hull(std::move(points))), radius_(radius) {
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < (n == 2 ? 1 : n) && n > 1; ++i) {
    const Vector2d way = vertices_[(i + 1) % n] - vertices_[i];
    const Vector2d d = way.normalized();
    edges_.push_back({vertices_[i], d, {d.y(), -d.x()}, way.norm()});
  }
}

double PlanarShape::signed_distance(const Vector2d& p) const {
  if (edges_.empty()) return (p - vertices_[0]).norm() - radius_;
  double plane = -std::numeric_limits<double>::infinity(), outside = std::numeric_limits<double>::infinity();
  for (const Edge& e : edges_) {
    const Vector2d d = p - e.from;
    const double height = d.dot(e.normal), along = d.dot(e.direction);
    plane = std::max(plane, height);
    const double beside = along - std::clamp(along, 0.0, e.length);
    outside = std::min(outside, height * height + beside * beside);
  }
  // A segment has no inside: its one plane says nothing.
  const double distance = plane <= 0 && edges_.size() > 1 ? plane : std::sqrt(outside);
  return distance - radius_;
}

double PlanarShape::reach() const {
  double most = 0;
  for (const Vector2d& v : vertices_) most = std::max(most, v.norm());
  return most + radius_;
}

Vector2d PlanarShape::lower() const {
  Vector2d out = vertices_[0];
  for (const Vector2d& v : vertices_) out = out.cwiseMin(v);
  return out.array() - radius_;
}

Vector2d PlanarShape::upper() const {
  Vector2d out = vertices_[0];
  for (const Vector2d& v : vertices_) out = out.cwiseMax(v);
  return out.array() + radius_;
}

PlanarShape minkowski_difference(const PlanarShape& a, const PlanarShape& b) {
  std::vector<Vector2d> points;
  points.reserve(a.vertices().size() * b.vertices().size());
  for (const Vector2d& v : a.vertices())
    for (const Vector2d& w : b.vertices()) points.push_back(v - w);
  return {std::move(points), a.radius() + b.radius()};
}

bool common_point(const PlanarShape& a, const Vector2d& p_a, const PlanarShape& b, const Vector2d& p_b, Vector2d& out) {
  constexpr double kInside = 1e-6;  // m
  std::vector<Vector2d> common = inner_polygon(a, p_a);
  const std::vector<Vector2d> other = inner_polygon(b, p_b);
  if (common.size() < 3 || other.size() < 3) return false;
  for (std::size_t i = 0; i < other.size(); ++i) common = clip(common, other[i], other[(i + 1) % other.size()]);
  if (common.empty()) return false;
  out.setZero();
  for (const Vector2d& p : common) out += p / static_cast<double>(common.size());
  return a.signed_distance(out - p_a) < -kInside && b.signed_distance(out - p_b) < -kInside;
}

}  // namespace mamo::mapf
