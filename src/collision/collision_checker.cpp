#include "mamo/collision/collision_checker.hpp"

#include "arm_parts.hpp"
#include "edge_check.hpp"
#include "obstacles.hpp"

namespace mamo {

struct CollisionChecker::Impl {
  Impl(std::shared_ptr<const ForwardKinematics> kinematics_in, const Scene& scene_in,
       const CollisionOptions& options_in)
      : kinematics(std::move(kinematics_in)),
        scene(scene_in),
        options(options_in),
        arm(*kinematics),
        obstacles(scene, options.padding),
        edges(*kinematics, arm, obstacles, options) {}

  const std::shared_ptr<const ForwardKinematics> kinematics;
  const Scene scene;
  const CollisionOptions options;
  collision::ArmParts arm;
  collision::Obstacles obstacles;
  collision::EdgeCheck edges;
  ObjectId held = kNoObject;
};

CollisionChecker::CollisionChecker(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene,
                                   const CollisionOptions& options)
    : impl_(std::make_unique<Impl>(std::move(kinematics), scene, options)) {}

CollisionChecker::~CollisionChecker() = default;

void CollisionChecker::set_state(const WorldState& state) { impl_->obstacles.set_state(state); }

void CollisionChecker::check(const Eigen::VectorXd& q, const ObjectSet& against, bool stop_at_first,
                             CollisionReport& out) {
  impl_->edges.configuration(q, against, impl_->held, stop_at_first, out);
}

bool CollisionChecker::check_edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const ObjectSet& forbidden,
                                  const ObjectSet& watched, CollisionReport& out) {
  return impl_->edges.edge(q0, q1, forbidden, watched, impl_->held, out);
}

std::vector<double> CollisionChecker::edge_samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  return impl_->edges.samples(q0, q1);
}

void CollisionChecker::attach(ObjectId object, LinkId link, const Eigen::Isometry3d& X_LO) {
  impl_->arm.hold(impl_->scene[object], link, X_LO);
  impl_->held = object;
}

void CollisionChecker::detach() {
  impl_->arm.release();
  impl_->held = kNoObject;
}

std::vector<std::pair<ObjectId, ObjectId>> CollisionChecker::overlapping_objects(double tolerance) {
  return collision::overlaps(impl_->scene, impl_->obstacles, tolerance);
}

std::int64_t CollisionChecker::checks() const { return impl_->edges.poses(); }
const CollisionOptions& CollisionChecker::options() const { return impl_->options; }

}  // namespace mamo
