#include "physics/body.hpp"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <mutex>

#include "physics/contact_pairs.hpp"

#include "mamo/physics/world.hpp"

namespace mamo {

struct FloorShape {
  btStaticPlaneShape plane;
};

namespace {

constexpr double kGravity = 9.81;  // m/s^2
/// Rolling resistance: how far ahead of the contact point a rolling body is carried (m). Without it a can that
/// has toppled rolls for ten seconds.
constexpr double kRollingArm = 0.002;

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Eigen::Isometry3d& X) {
  const auto R = X.linear();
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     to_bullet(Eigen::Vector3d(X.translation())));
}

Eigen::Isometry3d to_eigen(const btTransform& X) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) out.linear()(row, col) = X.getBasis()[row][col];
  out.translation() = to_eigen(X.getOrigin());
  return out;
}

std::unique_ptr<btRigidBody> make_rigid(btCollisionShape* shape, double friction) {
  // btRigidBody's constructor numbers bodies with a plain static counter (for debugging only).
  static std::mutex counter;
  const std::lock_guard lock(counter);
  btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, shape);
  info.m_friction = friction;
  return std::make_unique<btRigidBody>(info);
}

/// The axis of a small rotation times its angle (rad). The skew part is the axis times the sine: no loss near zero.
btVector3 rotation_vector(const btMatrix3x3& R) {
  const btVector3 v = 0.5 * btVector3(R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]);
  const double sine = std::min(1.0, static_cast<double>(v.length()));
  return sine > 0 ? v * (std::asin(sine) / sine) : v;
}

}  // namespace

Body::Body(const std::vector<PlacedShape>& shapes, const Eigen::Isometry3d& X_WB, ObjectId id, double mass,
           double friction)
    : shape_(std::make_unique<BodyShape>(shapes)),
      rigid_(make_rigid(shape_->bullet(), friction)),
      id_(id),
      mass_(mass) {
  // Contact points of a pair reach as far as the smaller threshold of the two, so half of each is enough.
  margin_ = 0.5 * shape_->bullet()->getContactBreakingThreshold(gContactBreakingThreshold);
  radius_ = shape_->bullet()->getAngularMotionDisc();
  for (const PlacedShape& s : shapes) {
    const Eigen::Matrix3d R_CS = shape_->X_BC().linear().transpose() * s.X_BS.linear();
    has_box_ = has_box_ || std::holds_alternative<Box>(s.shape);
    if (std::holds_alternative<Cylinder>(s.shape)) rolling_axes_.push_back(R_CS.col(2));
    if (std::holds_alternative<Sphere>(s.shape)) rolling_axes_.push_back(Eigen::Vector3d::Zero());
  }
  place(X_WB);
}

Body::Body(double floor_z, double friction)
    : floor_(new FloorShape{{btVector3(0, 0, 1), floor_z}}), rigid_(make_rigid(&floor_->plane, friction)), id_(kFloor) {
  bounds_ = Bounds{{-1e9, -1e9, -1e9}, {1e9, 1e9, floor_z + gContactBreakingThreshold}};
}

Body::~Body() = default;
Body::Body(Body&&) noexcept = default;

void Body::become(Role role) {
  role_ = role;
  const double mass = role == Role::free ? mass_ : 0.0;
  rigid_->setMassProps(mass, to_bullet(Eigen::Vector3d(shape_->inertia(mass))));
  rigid_->setGravity({0, 0, role == Role::free ? -kGravity : 0.0});
  // Bullet sets the static flag on bodies without mass; a kinematic body must not have it (PHYSICS section 4).
  constexpr int kStatic = btCollisionObject::CF_STATIC_OBJECT, kKinematic = btCollisionObject::CF_KINEMATIC_OBJECT;
  const int other = rigid_->getCollisionFlags() & ~(kStatic | kKinematic);
  rigid_->setCollisionFlags(other | (role == Role::driven ? kKinematic : role == Role::still ? kStatic : 0));
}

void Body::place(const Eigen::Isometry3d& X_WB) {
  const bool of_arm = id_ == kRobot && role_ == Role::driven;
  if (!of_arm) become(mass_ > 0 ? Role::free : Role::still);
  ignores_robot = false;
  rest_at(X_WB);
}

/// As if just made: nothing of the past is left.
void Body::rest_at(const Eigen::Isometry3d& X_WB) {
  const btVector3 zero(0, 0, 0);
  rigid_->setWorldTransform(to_bullet(Eigen::Isometry3d(X_WB * shape_->X_BC())));
  rigid_->setInterpolationWorldTransform(rigid_->getWorldTransform());
  rigid_->setLinearVelocity(zero);
  rigid_->setAngularVelocity(zero);
  rigid_->setInterpolationLinearVelocity(zero);
  rigid_->setInterpolationAngularVelocity(zero);
  rigid_->setPushVelocity(zero);
  rigid_->setTurnVelocity(zero);
  rigid_->clearForces();
  rigid_->updateInertiaTensor();
  rigid_->setCompanionId(-1);
  rigid_->setHitFraction(1);
  resist_rolling();
  awake_ = moving_ = false;
  rest_steps_ = 0;
  travel_ = 0;
  update_bounds();
}

void Body::attach_to(LinkId link, const Eigen::Isometry3d& X_LB) {
  become(Role::driven);
  link_ = link;
  X_LC_ = X_LB * shape_->X_BC();
  rigid_->setLinearVelocity({0, 0, 0});
  rigid_->setAngularVelocity({0, 0, 0});
  rigid_->clearForces();
  rigid_->updateInertiaTensor();
  awake_ = false;
}

void Body::drive(const Eigen::Isometry3d& X_WL, double rate) {
  const btTransform from = rigid_->getWorldTransform();
  const btTransform to = to_bullet(Eigen::Isometry3d(X_WL * X_LC_));
  moving_ = !(from == to);
  const btVector3 zero(0, 0, 0);
  rigid_->setLinearVelocity(moving_ ? (to.getOrigin() - from.getOrigin()) * rate : zero);
  rigid_->setAngularVelocity(moving_ ? rotation_vector(to.getBasis() * from.getBasis().transpose()) * rate : zero);
  update_travel(1.0 / rate);
}

void Body::arrive(const Eigen::Isometry3d& X_WL) {
  if (!moving_) return;
  rigid_->setWorldTransform(to_bullet(Eigen::Isometry3d(X_WL * X_LC_)));
}

void Body::apply_gravity() { rigid_->applyGravity(); }

void Body::integrate(double step_s) {
  btTransform next;
  rigid_->predictIntegratedTransform(step_s, next);
  rigid_->proceedToTransform(next);
  rigid_->clearForces();
  update_travel(step_s);
  resist_rolling();
  const bool slow = rigid_->getLinearVelocity().length2() < kRestSpeed * kRestSpeed &&
                    rigid_->getAngularVelocity().length2() < kRestAngularSpeed * kRestAngularSpeed;
  rest_steps_ = slow ? rest_steps_ + 1 : 0;
}

/// Bullet's rolling friction costs three rows per contact point, so what stands goes without.
void Body::resist_rolling() {
  const btVector3& up_in_C = rigid_->getWorldTransform().getBasis()[2];
  const auto rolls = [&](const Eigen::Vector3d& axis) { return std::abs(up_in_C.dot(to_bullet(axis))) < 0.9; };
  const bool any = std::any_of(rolling_axes_.begin(), rolling_axes_.end(), rolls);
  rigid_->setRollingFriction(any ? kRollingArm : 0.0);
}

void Body::wake() {
  awake_ = true;
  resist_rolling();
  rest_steps_ = 0;
}

void Body::put_to_sleep(const Eigen::Isometry3d& X_WB) { rest_at(X_WB); }

void Body::update_travel(double step_s) {
  travel_ = (rigid_->getLinearVelocity().length() + rigid_->getAngularVelocity().length() * radius_) * step_s;
  update_bounds();
}

World::Ball Body::ball() const {
  // Bullet's box of a shape, however turned, lies in the ball about its box at no turn.
  btVector3 centre;
  btScalar radius = 0;
  shape_->bullet()->getBoundingSphere(centre, radius);
  return {shape_->X_BC() * to_eigen(centre), radius + margin_ + 1e-6};
}

void Body::update_bounds() {
  btVector3 lo, hi;
  rigid_->getAabb(lo, hi);
  // If a pair closes in fast, one of the two covers at least half of that.
  const double wide = margin_ + (travel_ > ContactPairs::kFastTravel / 2 ? travel_ : 0);
  for (int k = 0; k < 3; ++k) {
    bounds_.min[static_cast<std::size_t>(k)] = lo[k] - wide;
    bounds_.max[static_cast<std::size_t>(k)] = hi[k] + wide;
  }
}

Eigen::Isometry3d Body::X_WB() const { return to_eigen(rigid_->getWorldTransform()) * shape_->X_BC().inverse(); }
Eigen::Vector3d Body::linear_velocity() const { return to_eigen(rigid_->getLinearVelocity()); }
Eigen::Vector3d Body::angular_velocity() const { return to_eigen(rigid_->getAngularVelocity()); }

}  // namespace mamo
