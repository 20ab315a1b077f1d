#include "fcl_geometry.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "hull_offset.hpp"

namespace mamo::collision {
namespace {

constexpr double kLeast = 1e-6;  // m: shrinking never makes a size zero or negative

template <class T, class... Args>
Geometry made(Args&&... args) {
  auto geometry = std::make_shared<T>(std::forward<Args>(args)...);
  geometry->computeLocalAABB();
  return geometry;
}

Geometry made_hull(const ConvexHull& hull, double padding) {
  auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>(offset_vertices(hull, padding));
  auto faces = std::make_shared<std::vector<int>>();
  // Without faces FCL searches all vertices for the extreme one, which is right for any set of points. With
  // faces it walks along edges, which is right only if they are those of the hull, and a moved vertex may spoil that.
  int count = 0;
  if (padding == 0) {
    for (const auto& t : hull.triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
    count = static_cast<int>(hull.triangles.size());
  }
  return made<fcl::Convexd>(std::shared_ptr<const std::vector<Eigen::Vector3d>>(vertices), count,
                            std::shared_ptr<const std::vector<int>>(faces));
}

}  // namespace

Geometry make_geometry(const Shape& shape, double padding) {
  const auto grown = [&](double size) { return std::max(kLeast, size + padding); };
  if (const Box* b = std::get_if<Box>(&shape))
    return made<fcl::Boxd>(2 * grown(b->size.x() / 2), 2 * grown(b->size.y() / 2), 2 * grown(b->size.z() / 2));
  if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    return made<fcl::Cylinderd>(grown(c->radius), 2 * grown(c->length / 2));
  if (const Sphere* s = std::get_if<Sphere>(&shape)) return made<fcl::Sphered>(grown(s->radius));
  return made_hull(*std::get<Mesh>(shape).hull, padding);
}

bool intersect(const fcl::CollisionGeometry<double>& a, const Eigen::Isometry3d& X_WA,
               const fcl::CollisionGeometry<double>& b, const Eigen::Isometry3d& X_WB) {
  static const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  return fcl::collide(&a, X_WA, &b, X_WB, request, result) > 0;
}

}  // namespace mamo::collision
