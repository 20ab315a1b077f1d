#include "physics/body_shape.hpp"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <Eigen/Eigenvalues>

#include "physics/mass_properties.hpp"

namespace mamo {
namespace {

/// Bullet's margin is a rounding inside the primitive. It shrinks with small bodies by itself (a tenth of the
/// smallest half extent); beyond this it rounds off edges that matter (PHYSICS section 4). m.
constexpr double kLargestMargin = 0.005;
/// A hull's margin lies outside its points, so the points are pulled in by as much. m.
constexpr double kHullMargin = 0.001;

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Eigen::Isometry3d& X) {
  const auto R = X.linear();
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     to_bullet(Eigen::Vector3d(X.translation())));
}

std::unique_ptr<btCollisionShape> cap_margin(std::unique_ptr<btConvexInternalShape> shape) {
  if (shape->getMargin() > kLargestMargin) shape->setMargin(kLargestMargin);
  return shape;
}

/// The hull seen from frame C, each axis of its bounds scaled so that points plus margin fill the bounds again.
std::unique_ptr<btCollisionShape> make_hull(const ConvexHull& hull, const Eigen::Isometry3d& X_CS) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : hull.vertices) box.extend(X_CS * v);
  const Eigen::Vector3d half = box.sizes() / 2;
  const double margin = std::min(kHullMargin, 0.1 * half.minCoeff());
  const Eigen::Vector3d scale = (half.array() - margin) / half.array();
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3d& v : hull.vertices)
    shape->addPoint(to_bullet(Eigen::Vector3d(box.center() + scale.cwiseProduct(X_CS * v - box.center()))), false);
  shape->recalcLocalAabb();
  shape->setMargin(margin);
  return shape;
}

std::unique_ptr<btCollisionShape> make_primitive(const Shape& shape) {
  if (const Box* b = std::get_if<Box>(&shape))
    return cap_margin(std::make_unique<btBoxShape>(to_bullet(Eigen::Vector3d(b->size / 2))));
  if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    return cap_margin(std::make_unique<btCylinderShapeZ>(btVector3(c->radius, c->radius, c->length / 2)));
  return std::make_unique<btSphereShape>(std::get<Sphere>(shape).radius);
}

}  // namespace

struct BodyShape::Impl {
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btCompoundShape> compound;  // if there are several parts
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  Eigen::Vector3d inertia_per_kg;

  /// A single primitive is aligned with its own principal axes already.
  void choose_frame(const std::vector<PlacedShape>& shapes, const MassProperties& m) {
    if (shapes.size() == 1 && !std::holds_alternative<Mesh>(shapes[0].shape)) {
      X_BC = shapes[0].X_BS;
      inertia_per_kg = mass_properties(shapes[0].shape).inertia.diagonal() / m.volume;
      return;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(m.inertia);
    Eigen::Matrix3d R = axes.eigenvectors();
    if (R.determinant() < 0) R.col(2) *= -1;
    X_BC.linear() = R;
    X_BC.translation() = m.centre;
    inertia_per_kg = axes.eigenvalues() / m.volume;
  }
};

BodyShape::BodyShape(const std::vector<PlacedShape>& shapes) : impl_(std::make_unique<Impl>()) {
  impl_->choose_frame(shapes, mass_properties(shapes));
  if (shapes.size() > 1) impl_->compound = std::make_unique<btCompoundShape>();
  for (const PlacedShape& s : shapes) {
    const Eigen::Isometry3d X_CS = impl_->X_BC.inverse() * s.X_BS;
    Eigen::Isometry3d X_in_compound = X_CS;
    if (const Mesh* mesh = std::get_if<Mesh>(&s.shape)) {
      impl_->parts.push_back(make_hull(*mesh->hull, X_CS));
      X_in_compound.setIdentity();
    } else {
      impl_->parts.push_back(make_primitive(s.shape));
    }
    if (impl_->compound) impl_->compound->addChildShape(to_bullet(X_in_compound), impl_->parts.back().get());
  }
}

BodyShape::~BodyShape() = default;

btCollisionShape* BodyShape::bullet() const {
  return impl_->compound ? impl_->compound.get() : impl_->parts.front().get();
}

const Eigen::Isometry3d& BodyShape::X_BC() const { return impl_->X_BC; }

Eigen::Vector3d BodyShape::inertia(double mass) const { return mass * impl_->inertia_per_kg; }

}  // namespace mamo
