#include "mamo/model/shape.hpp"

#include <cstdio>
#include <numbers>

namespace mamo {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

double hull_plane_distance(const ConvexHull& hull, const Eigen::Vector3d& point) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& t : hull.triangles) {
    const Eigen::Vector3d& a = hull.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d n =
        (hull.vertices[static_cast<std::size_t>(t[1])] - a).cross(hull.vertices[static_cast<std::size_t>(t[2])] - a);
    const double length = n.norm();
    if (length > 0) largest = std::max(largest, n.dot(point - a) / length);
  }
  return largest;
}

}  // namespace

double volume(const Shape& shape) {
  return std::visit(Overloaded{[](const Box& b) { return b.size.prod(); },
                               [](const Cylinder& c) { return std::numbers::pi * c.radius * c.radius * c.length; },
                               [](const Sphere& s) { return 4.0 / 3.0 * std::numbers::pi * std::pow(s.radius, 3); },
                               [](const Mesh& m) { return m.hull->volume; }},
                    shape);
}

Eigen::Vector3d support(const Shape& shape, const Eigen::Vector3d& d) {
  return std::visit(Overloaded{[&](const Box& b) -> Eigen::Vector3d {
                                 return {std::copysign(b.size.x() / 2, d.x()), std::copysign(b.size.y() / 2, d.y()),
                                         std::copysign(b.size.z() / 2, d.z())};
                               },
                               [&](const Cylinder& c) -> Eigen::Vector3d {
                                 const double r = std::hypot(d.x(), d.y());
                                 const double k = r > 0 ? c.radius / r : 0.0;
                                 return {k * d.x(), k * d.y(), std::copysign(c.length / 2, d.z())};
                               },
                               [&](const Sphere& s) -> Eigen::Vector3d {
                                 const double n = d.norm();
                                 return n > 0 ? Eigen::Vector3d(d * (s.radius / n)) : Eigen::Vector3d(0, 0, s.radius);
                               },
                               [&](const Mesh& m) -> Eigen::Vector3d {
                                 const Eigen::Vector3d* best = &m.hull->vertices.front();
                                 for (const auto& v : m.hull->vertices)
                                   if (v.dot(d) > best->dot(d)) best = &v;
                                 return *best;
                               }},
                    shape);
}

Eigen::AlignedBox3d bounds(const Shape& shape, const Eigen::Isometry3d& X) {
  Eigen::AlignedBox3d box;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d d = X.linear().row(axis).transpose();  // world axis in the shape's frame
    box.max()[axis] = X.translation()[axis] + support(shape, d).dot(d);
    box.min()[axis] = X.translation()[axis] + support(shape, -d).dot(d);
  }
  return box;
}

double signed_distance(const Shape& shape, const Eigen::Vector3d& p) {
  return std::visit(Overloaded{[&](const Box& b) {
                                 const Eigen::Vector3d d = p.cwiseAbs() - b.size / 2;
                                 return d.cwiseMax(0.0).norm() + std::min(d.maxCoeff(), 0.0);
                               },
                               [&](const Cylinder& c) {
                                 const Eigen::Vector2d d(p.head<2>().norm() - c.radius, std::abs(p.z()) - c.length / 2);
                                 return d.cwiseMax(0.0).norm() + std::min(d.maxCoeff(), 0.0);
                               },
                               [&](const Sphere& s) { return p.norm() - s.radius; },
                               [&](const Mesh& m) { return hull_plane_distance(*m.hull, p); }},
                    shape);
}

std::string describe(const Shape& shape) {
  char text[160];
  std::visit(
      Overloaded{
          [&](const Box& b) {
            std::snprintf(text, sizeof text, "box %g x %g x %g", b.size.x(), b.size.y(), b.size.z());
          },
          [&](const Cylinder& c) { std::snprintf(text, sizeof text, "cylinder r %g l %g", c.radius, c.length); },
          [&](const Sphere& s) { std::snprintf(text, sizeof text, "sphere r %g", s.radius); },
          [&](const Mesh& m) { std::snprintf(text, sizeof text, "hull of %zu vertices", m.hull->vertices.size()); }},
      shape);
  return text;
}

}  // namespace mamo
