#include "physics/mass_properties.hpp"

#include <numbers>

namespace mamo {
namespace {

/// Inertia that a point mass adds at an offset from the centre (the parallel-axis term).
Eigen::Matrix3d offset_inertia(double mass, const Eigen::Vector3d& d) {
  return mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
}

MassProperties of_box(const Box& b) {
  const Eigen::Vector3d s = b.size.cwiseAbs2();
  MassProperties m;
  m.volume = b.size.prod();
  m.inertia.diagonal() = m.volume / 12.0 * Eigen::Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  return m;
}

MassProperties of_cylinder(const Cylinder& c) {
  MassProperties m;
  m.volume = std::numbers::pi * c.radius * c.radius * c.length;
  const double across = m.volume * (3 * c.radius * c.radius + c.length * c.length) / 12.0;
  m.inertia.diagonal() = Eigen::Vector3d(across, across, m.volume * c.radius * c.radius / 2.0);
  return m;
}

MassProperties of_sphere(const Sphere& s) {
  MassProperties m;
  m.volume = 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
  m.inertia.diagonal().setConstant(0.4 * m.volume * s.radius * s.radius);
  return m;
}

/// Sum over tetrahedra from the hull's first vertex: second moments of a simplex are exact in its vertices.
MassProperties of_hull(const ConvexHull& hull) {
  MassProperties m;
  const Eigen::Vector3d origin = hull.vertices.front();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // integral of x x^T about the origin vertex
  for (const auto& t : hull.triangles) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
      edges.col(k) = hull.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])] - origin;
    const double v = edges.determinant() / 6.0;
    const Eigen::Vector3d sum = edges.rowwise().sum();
    m.volume += v;
    m.centre += v / 4.0 * sum;
    moment += v / 20.0 * (edges * edges.transpose() + sum * sum.transpose());
  }
  m.centre /= m.volume;
  moment -= m.volume * m.centre * m.centre.transpose();
  m.inertia = moment.trace() * Eigen::Matrix3d::Identity() - moment;
  m.centre += origin;
  return m;
}

}  // namespace

MassProperties mass_properties(const Shape& shape) {
  if (const Box* b = std::get_if<Box>(&shape)) return of_box(*b);
  if (const Cylinder* c = std::get_if<Cylinder>(&shape)) return of_cylinder(*c);
  if (const Sphere* s = std::get_if<Sphere>(&shape)) return of_sphere(*s);
  return of_hull(*std::get<Mesh>(shape).hull);
}

MassProperties mass_properties(const std::vector<PlacedShape>& shapes) {
  std::vector<MassProperties> parts;
  MassProperties whole;
  for (const PlacedShape& s : shapes) {
    MassProperties part = mass_properties(s.shape);
    part.centre = s.X_BS * part.centre;
    part.inertia = s.X_BS.linear() * part.inertia * s.X_BS.linear().transpose();
    whole.volume += part.volume;
    whole.centre += part.volume * part.centre;
    parts.push_back(part);
  }
  whole.centre /= whole.volume;
  for (const MassProperties& part : parts)
    whole.inertia += part.inertia + offset_inertia(part.volume, part.centre - whole.centre);
  return whole;
}

}  // namespace mamo
