#include "verify/solid.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>

namespace mamo::verify {
namespace {

constexpr double kSmallest = 1e-4;  // m: what a shape is never shrunk below

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Box& box, double inflation) {
  const Eigen::Vector3d size = (box.size.array() + 2 * inflation).max(kSmallest);
  return std::make_shared<fcl::Boxd>(size);
}

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Cylinder& cylinder, double inflation) {
  return std::make_shared<fcl::Cylinderd>(std::max(cylinder.radius + inflation, kSmallest),
                                          std::max(cylinder.length + 2 * inflation, kSmallest));
}

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Sphere& sphere, double inflation) {
  return std::make_shared<fcl::Sphered>(std::max(sphere.radius + inflation, kSmallest));
}

/// Vertices move away from the centroid, which grows a hull by at least `inflation` at its vertices and by less
/// at the middle of a face: enough for tolerances of a millimetre.
std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Mesh& mesh, double inflation) {
  auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>(mesh.hull->vertices);
  for (Eigen::Vector3d& v : *vertices) {
    const Eigen::Vector3d arm = v - mesh.hull->centroid;
    const double length = arm.norm();
    if (length > 0) v = mesh.hull->centroid + arm * (std::max(length + inflation, kSmallest) / length);
  }
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : mesh.hull->triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.hull->triangles.size()), faces);
}

}  // namespace

struct Solid::Impl {
  Eigen::Isometry3d X_BS;
  fcl::CollisionObjectd object;
};

Solid::Solid(const PlacedShape& placed, double inflation)
    : impl_(new Impl{placed.X_BS,
                     fcl::CollisionObjectd(std::visit([&](const auto& s) { return geometry_of(s, inflation); },
                                                      placed.shape))}) {
  place(Eigen::Isometry3d::Identity());
}
Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;
Solid& Solid::operator=(Solid&&) noexcept = default;

void Solid::place(const Eigen::Isometry3d& X_WB) {
  impl_->object.setTransform(X_WB * impl_->X_BS);
  impl_->object.computeAABB();
}

bool Solid::overlaps(const Solid& other) const {
  if (!impl_->object.getAABB().overlap(other.impl_->object.getAABB())) return false;
  fcl::CollisionRequestd request;  // boolean: no contact points, FCL 0.7's penetration depth is not robust
  fcl::CollisionResultd result;
  return fcl::collide(&impl_->object, &other.impl_->object, request, result) > 0;
}

std::vector<Solid> solids_of(const std::vector<PlacedShape>& shapes, double inflation) {
  std::vector<Solid> body;
  body.reserve(shapes.size());
  for (const PlacedShape& shape : shapes) body.emplace_back(shape, inflation);
  return body;
}

void place(std::vector<Solid>& body, const Eigen::Isometry3d& X_WB) {
  for (Solid& solid : body) solid.place(X_WB);
}

bool overlap(const std::vector<Solid>& a, const std::vector<Solid>& b) {
  for (const Solid& s : a)
    for (const Solid& t : b)
      if (s.overlaps(t)) return true;
  return false;
}

}  // namespace mamo::verify
