// The reference that PHYSICS.md calls naive: Bullet as its manual shows it. A fresh world for every push, every
// object awake, 240 Hz, 50 iterations, everything else at its default.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/scene.hpp"

namespace mamo::bench {

class NaiveBullet {
 public:
  NaiveBullet(const ForwardKinematics& kinematics, const Scene& scene, const Eigen::VectorXd& q);
  ~NaiveBullet();
  void step(const Eigen::VectorXd& q);
  Eigen::Vector3d position(ObjectId id) const;

 private:
  btRigidBody* add(const std::vector<PlacedShape>& shapes, const Eigen::Isometry3d& X, double mass, double friction,
                   bool kinematic);
  const ForwardKinematics& kinematics_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::pair<std::size_t, btRigidBody*>> links_;
  std::vector<btRigidBody*> objects_;
  std::vector<Eigen::Isometry3d> X_WL_;
};

inline btTransform bullet(const Eigen::Isometry3d& X) {
  const auto R = X.linear();
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     btVector3(X.translation().x(), X.translation().y(), X.translation().z()));
}

inline NaiveBullet::NaiveBullet(const ForwardKinematics& kinematics, const Scene& scene, const Eigen::VectorXd& q)
    : kinematics_(kinematics) {
  world_.setGravity({0, 0, -9.81});
  world_.getSolverInfo().m_numIterations = 50;
  shapes_.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0));
  bodies_.push_back(std::make_unique<btRigidBody>(0, nullptr, shapes_.back().get()));
  world_.addRigidBody(bodies_.back().get());
  kinematics.link_poses(q, X_WL_);
  const std::vector<bool> moving = kinematics.robot().moving_links();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Link& link = kinematics.robot().model->links[i];
    if (link.collision.empty()) continue;
    btRigidBody* body = add(link.collision, X_WL_[i], 0, scene.physics.robot_friction, moving[i]);
    if (moving[i]) links_.emplace_back(i, body);
  }
  for (const Object& o : scene.objects)
    objects_.push_back(add(o.shapes, o.X_WO, o.fixture() ? 0 : o.mass, o.friction, false));
}

inline NaiveBullet::~NaiveBullet() {
  for (auto& b : bodies_) world_.removeRigidBody(b.get());
}

/// Every body of the bench has one primitive; links have it off their origin, so they are compounds.
inline btRigidBody* NaiveBullet::add(const std::vector<PlacedShape>& placed, const Eigen::Isometry3d& X, double mass,
                                     double friction, bool kinematic) {
  const Shape& shape = placed.front().shape;
  if (const Box* b = std::get_if<Box>(&shape))
    shapes_.push_back(std::make_unique<btBoxShape>(btVector3(b->size.x() / 2, b->size.y() / 2, b->size.z() / 2)));
  else if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    shapes_.push_back(std::make_unique<btCylinderShapeZ>(btVector3(c->radius, c->radius, c->length / 2)));
  else
    shapes_.push_back(std::make_unique<btSphereShape>(std::get<Sphere>(shape).radius));
  btCollisionShape* collision = shapes_.back().get();
  btVector3 inertia(0, 0, 0);
  if (mass > 0) collision->calculateLocalInertia(mass, inertia);
  if (!placed.front().X_BS.isApprox(Eigen::Isometry3d::Identity())) {
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(bullet(placed.front().X_BS), collision);
    shapes_.push_back(std::move(compound));
    collision = shapes_.back().get();
  }
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, collision, inertia);
  info.m_friction = friction;
  info.m_startWorldTransform = bullet(X);
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  btRigidBody* body = bodies_.back().get();
  if (kinematic)
    body->setCollisionFlags((body->getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
                            btCollisionObject::CF_KINEMATIC_OBJECT);
  body->setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(body);
  return body;
}

inline void NaiveBullet::step(const Eigen::VectorXd& q) {
  kinematics_.link_poses(q, X_WL_);
  for (const auto& [link, body] : links_) body->setWorldTransform(bullet(X_WL_[link]));
  world_.stepSimulation(1.0 / 240, 0, 1.0 / 240);
}

inline Eigen::Vector3d NaiveBullet::position(ObjectId id) const {
  const btVector3 p = objects_[id.index()]->getWorldTransform().getOrigin();
  return {p.x(), p.y(), p.z()};
}

}  // namespace mamo::bench
