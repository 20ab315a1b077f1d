// Physics that can be worked out on paper, and Bullet's own world as an oracle.
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include "mamo/physics/world.hpp"
#include "support/pusher.hpp"

namespace mamo {
namespace {

using namespace pushing;

const Eigen::VectorXd kAway = Eigen::Vector3d(-2, 0, 2);

/// Pushes `id` from behind to a speed (m/s) and takes the finger out of the way; the world steps on until it stands.
struct Slide {
  double speed = 0, distance = 0;  // at release, from there to rest
};
Slide slide(Scene scene, ObjectId id, double speed) {
  World world(gantry({{Box{{0.02, 0.2, 0.02}}, at(0, 0, 0)}}), scene);
  const double dt = scene.physics.step, z = scene[id].X_WO.translation().z();
  Eigen::Vector3d q(-0.5, 0, z);
  world.reset(ObjectSet::all(scene), WorldState::start_of(scene), q);
  while (world.linear_velocity(id).x() < speed * 0.999 && q.x() < 0.5) q.x() += speed * dt, world.step(q);
  for (int k = 0; k < 10; ++k) q.x() += speed * dt, world.step(q);
  Slide out{world.linear_velocity(id).x(), 0};
  const double from = world.X_WO(id).translation().x();
  q.x() -= 0.02;
  for (int k = 0; k < 600 && world.linear_velocity(id).norm() > 1e-4; ++k) world.step(q);
  out.distance = world.X_WO(id).translation().x() - from;
  return out;
}

TEST(WorldDynamics, ASlidingBlockStopsAfterVSquaredOverTwoMuG) {
  for (const double friction : {0.3, 0.5, 0.9}) {
    Scene scene = table();
    scene.objects[0].friction = 0.8;
    const ObjectId id = add(scene, block("b", 0, 0, {0.08, 0.08, 0.02}, 0.4, friction));
    const Slide s = slide(scene, id, 1.0);
    const double expected = s.speed * s.speed / (2 * 0.8 * friction * 9.81);
    EXPECT_NEAR(s.distance, expected, 0.05 * expected) << "friction " << friction << " speed " << s.speed;
    RecordProperty("slide_ratio_" + std::to_string(friction), std::to_string(s.distance / expected));
  }
}

/// Largest drift (m) of a can on the table that is kept awake for 5 s.
double drift(const PhysicsSettings& settings, double radius, double length) {
  Scene scene = table();
  scene.physics = settings;
  const ObjectId id = add(scene, can("c", 0.3, 0.2, radius, length, 0.35, 0.9));
  World world(gantry(), scene);
  world.reset(ObjectSet::all(scene), WorldState::start_of(scene), kAway);
  const Eigen::Vector3d from = world.X_WO(id).translation();
  double largest = 0;
  for (int k = 0; k < static_cast<int>(5 / settings.step); ++k) {
    world.wake(id);
    world.step(kAway);
    largest = std::max(largest, (world.X_WO(id).translation() - from).norm());
  }
  EXPECT_GT(largest, 0) << "not awake";
  return largest;
}

TEST(WorldDynamics, AStandingCanKeptAwakeHardlyDrifts) {
  const PhysicsSettings fine{.step = 1.0 / 240, .iterations = 50};
  double with_default = 0, with_fine = 0;
  for (const auto& [radius, length] : {std::pair{0.033, 0.101}, {0.05, 0.14}, {0.04, 0.25}, {0.037, 0.08}}) {
    with_default = std::max(with_default, drift(PhysicsSettings{}, radius, length));
    with_fine = std::max(with_fine, drift(fine, radius, length));
  }
  std::printf("drift in 5 s: %.3f mm with the default settings, %.3f mm at 240 Hz and 50 iterations\n",
              1e3 * with_default, 1e3 * with_fine);
  EXPECT_LT(with_default, 0.002);
  EXPECT_LT(with_fine, 0.0005);
}

TEST(WorldDynamics, WhatNothingComesNearDoesNotMoveAtAll) {
  const Scene scene = fixtures::cluttered_shelf(15, 5, 1);
  World world(gantry(), scene);
  world.reset(ObjectSet::all(scene), WorldState::start_of(scene), kAway);
  for (int k = 0; k < 600; ++k) world.step(kAway + Eigen::Vector3d(1e-3 * k, 0, 0));
  for (const ObjectId id : ObjectSet::all(scene).ids()) {
    EXPECT_FALSE(world.awake(id));
    EXPECT_EQ(quantise(world.X_WO(id)), WorldState::start_of(scene)[id]);
  }
}

// Bullet's own world, everything awake and driven the same way, computes the same motion of a single object.
TEST(WorldDynamics, APushedBlockMovesAsInBulletsOwnWorld) {
  Scene scene = table();
  scene.physics.step = 1.0 / 240;
  const Eigen::Vector3d half(0.04, 0.05, 0.03);
  const ObjectId id = add(scene, block("b", 0, 0, 2 * half, 0.4, 0.6));
  World world(gantry({{Box{{0.04, 0.04, 0.04}}, at(0, 0, 0)}}), scene);

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld oracle(&dispatcher, &broadphase, &solver, &configuration);
  oracle.setGravity({0, 0, -9.81});
  oracle.getSolverInfo().m_numIterations = scene.physics.iterations;
  oracle.getSolverInfo().m_solverMode |= SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
  btBoxShape table_shape({1, 1, 0.05}), block_shape({half.x(), half.y(), half.z()}), finger_shape({0.02, 0.02, 0.02});
  for (btBoxShape* shape : {&table_shape, &block_shape, &finger_shape}) shape->setMargin(std::min(shape->getMargin(), 0.005));
  const auto body = [&](double mass, btBoxShape& shape, const btVector3& p, double friction) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    auto b = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &shape, inertia));
    b->setWorldTransform(btTransform(btMatrix3x3::getIdentity(), p));
    b->setInterpolationWorldTransform(b->getWorldTransform());
    b->setFriction(friction);
    b->setActivationState(DISABLE_DEACTIVATION);
    return b;
  };
  const auto table_body = body(0, table_shape, {0, 0, kTop - 0.05}, 0.8);
  const auto finger = body(0, finger_shape, {-0.1, 0.01, kTop + 0.03}, 0.5);
  finger->setCollisionFlags((finger->getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
                            btCollisionObject::CF_KINEMATIC_OBJECT);
  const auto pushed = body(0.4, block_shape, {0, 0, kTop + half.z()}, 0.6);
  // The order in which our world numbers them: links, then objects by id.
  for (btRigidBody* b : {finger.get(), table_body.get(), pushed.get()}) oracle.addRigidBody(b);

  Eigen::Vector3d q(-0.1, 0.01, kTop + 0.03);
  world.reset(ObjectSet::all(scene), WorldState::start_of(scene), q);
  double apart = 0;
  for (int k = 0; k < 480; ++k) {
    q.x() += 0.15 * scene.physics.step;
    world.step(q);
    finger->setWorldTransform(btTransform(btMatrix3x3::getIdentity(), {q.x(), q.y(), q.z()}));
    oracle.stepSimulation(scene.physics.step, 0, scene.physics.step);
    const btVector3 p = pushed->getWorldTransform().getOrigin();
    apart = std::max(apart, (world.X_WO(id).translation() - Eigen::Vector3d(p.x(), p.y(), p.z())).norm());
  }
  EXPECT_GT(world.X_WO(id).translation().x(), 0.1);
  std::printf("largest distance from Bullet's own world: %.2g m\n", apart);
  EXPECT_LT(apart, 0.002);
  for (btRigidBody* b : {finger.get(), table_body.get(), pushed.get()}) oracle.removeRigidBody(b);
}

}  // namespace
}  // namespace mamo
