#include "physics/contact_pairs.hpp"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <limits>

namespace mamo {
namespace {

btDefaultCollisionConstructionInfo small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 256;  // more than that comes from the heap
  info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  return info;
}

/// Keeps the smallest distance of the points that a query finds.
struct SmallestDistance final : btManifoldResult {
  SmallestDistance(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b) : btManifoldResult(a, b) {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar depth) override { value = std::min(value, depth); }
  btScalar value = std::numeric_limits<btScalar>::infinity();
};

}  // namespace

struct ContactPairs::Bullet {
  btDefaultCollisionConfiguration configuration{small_pools()};
  btCollisionDispatcher dispatcher{&configuration};
  btDispatcherInfo info;
  btManifoldArray scratch;

  void destroy(btCollisionAlgorithm* algorithm) {
    algorithm->~btCollisionAlgorithm();
    dispatcher.freeCollisionAlgorithm(algorithm);
  }
  void release(btPersistentManifold*& manifold) {
    if (manifold) dispatcher.releaseManifold(manifold);
    manifold = nullptr;
  }
};

ContactPairs::ContactPairs(const std::vector<btCollisionObject*>& bodies)
    : count_(static_cast<std::uint32_t>(bodies.size())), bodies_(bodies), bullet_(std::make_unique<Bullet>()) {
  table_.resize(static_cast<std::size_t>(count_) * count_);
}

ContactPairs::~ContactPairs() { clear(); }

void ContactPairs::remove(std::size_t live_index) {
  Pair& pair = *live_[live_index];
  bullet_->destroy(pair.algorithm);
  pair.algorithm = nullptr;
  bullet_->release(pair.predicted);
  pair.manifolds.clear();
  pair.points = 0;
  live_[live_index] = live_.back();
  live_.pop_back();
}

void ContactPairs::clear() {
  while (!live_.empty()) remove(live_.size() - 1);
  visited_.clear();
}

void ContactPairs::collide(const std::vector<std::uint32_t>& keys, const std::vector<double>& travel, double step_s) {
  ++stamp_;
  visited_.clear();
  for (const std::uint32_t key : keys) {
    if (!table_[key]) table_[key] = std::make_unique<Pair>(), table_[key]->key = key;
    Pair& pair = *table_[key];
    const btCollisionObject* a = bodies_[key / count_];
    const btCollisionObject* b = bodies_[key % count_];
    const btCollisionObjectWrapper wrap_a(nullptr, a->getCollisionShape(), a, a->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, b->getCollisionShape(), b, b->getWorldTransform(), -1, -1);
    if (!pair.algorithm) {
      pair.algorithm = bullet_->dispatcher.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
      live_.push_back(&pair);
    }
    btManifoldResult result(&wrap_a, &wrap_b);
    pair.algorithm->processCollision(&wrap_a, &wrap_b, bullet_->info, &result);
    bullet_->release(pair.predicted);
    const double closing = travel[key / count_] + travel[key % count_];
    if (closing > kFastTravel) predict(pair, closing, step_s);
    gather(pair);
    pair.stamp = stamp_;
    visited_.push_back(&pair);
  }
}

/// Bullet finds the nearest or deepest points at the present poses: of a can that topples the rim it stands on,
/// never the one that comes down and would be centimetres deep a step later. So the points are found where the
/// bodies will be, then carried back: the solver lets a point close its gap within the step, and no more.
void ContactPairs::predict(Pair& pair, double travel, double step_s) {
  btRigidBody* a = btRigidBody::upcast(bodies_[pair.key / count_]);
  btRigidBody* b = btRigidBody::upcast(bodies_[pair.key % count_]);
  const btTransform from_a = a->getWorldTransform(), from_b = b->getWorldTransform();
  btTransform to_a, to_b;
  a->predictIntegratedTransform(step_s, to_a);
  b->predictIntegratedTransform(step_s, to_b);
  a->setWorldTransform(to_a);
  b->setWorldTransform(to_b);
  pair.predicted = bullet_->dispatcher.getNewManifold(a, b);
  {
    const btCollisionObjectWrapper wrap_a(nullptr, a->getCollisionShape(), a, to_a, -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, b->getCollisionShape(), b, to_b, -1, -1);
    btCollisionAlgorithm* algorithm =
        bullet_->dispatcher.findAlgorithm(&wrap_a, &wrap_b, pair.predicted, BT_CONTACT_POINT_ALGORITHMS);
    btManifoldResult result(&wrap_a, &wrap_b);
    result.setPersistentManifold(pair.predicted);
    algorithm->processCollision(&wrap_a, &wrap_b, bullet_->info, &result);
    bullet_->destroy(algorithm);
  }
  a->setWorldTransform(from_a);
  b->setWorldTransform(from_b);
  pair.predicted->setContactBreakingThreshold(pair.predicted->getContactBreakingThreshold() + travel);
  pair.predicted->refreshContactPoints(from_a, from_b);
}

void ContactPairs::gather(Pair& pair) {
  bullet_->scratch.resizeNoInitialize(0);
  pair.algorithm->getAllContactManifolds(bullet_->scratch);
  if (pair.predicted) bullet_->scratch.push_back(pair.predicted);
  pair.manifolds.clear();
  pair.points = 0;
  for (int i = 0; i < bullet_->scratch.size(); ++i) {
    pair.manifolds.push_back(bullet_->scratch[i]);
    pair.points += bullet_->scratch[i]->getNumContacts();
  }
}

std::optional<ContactPairs::TouchPoint> ContactPairs::touch_point(const Pair& pair) {
  std::optional<TouchPoint> deepest;
  if (pair.points == 0) return deepest;
  for (const btPersistentManifold* m : pair.manifolds)
    for (int i = 0; i < m->getNumContacts(); ++i) {
      const btManifoldPoint& p = m->getContactPoint(i);
      if (p.getDistance() > 0 && p.getAppliedImpulse() <= 0) continue;
      const double depth = std::max(-p.getDistance(), 0.0);
      if (deepest && depth <= deepest->depth) continue;
      const btVector3& at = p.getPositionWorldOnB();
      deepest = TouchPoint{depth, {at.x(), at.y(), at.z()}};
    }
  return deepest;
}

btDispatcher* ContactPairs::dispatcher() { return &bullet_->dispatcher; }

double ContactPairs::distance(int ia, int ib, double limit) {
  const btCollisionObject* a = bodies_[static_cast<std::size_t>(ia)];
  const btCollisionObject* b = bodies_[static_cast<std::size_t>(ib)];
  const btCollisionObjectWrapper wrap_a(nullptr, a->getCollisionShape(), a, a->getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper wrap_b(nullptr, b->getCollisionShape(), b, b->getWorldTransform(), -1, -1);
  btCollisionAlgorithm* algorithm =
      bullet_->dispatcher.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CLOSEST_POINT_ALGORITHMS);
  SmallestDistance result(&wrap_a, &wrap_b);
  result.m_closestPointDistanceThreshold = limit;
  algorithm->processCollision(&wrap_a, &wrap_b, bullet_->info, &result);
  bullet_->destroy(algorithm);
  return result.value < limit ? result.value : std::numeric_limits<double>::infinity();
}

}  // namespace mamo
