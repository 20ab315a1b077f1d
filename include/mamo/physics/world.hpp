// Bullet behind one class: a world that forgets its past, a kinematic arm, the objects, raw observations.
// No judgement here: physics/evaluation.hpp watches constraints for planners, verify has its own loop.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/scene.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo {

/// Two bodies with at least one contact point of distance <= 0. a < b by id value, kRobot and kFloor
/// included; depth = the deepest penetration (m, >= 0). Contacts come sorted by (a, b), one per pair.
struct Contact {
  ObjectId a, b;
  double depth = 0;
};

/// One instance per worker. After reset() what follows is a pure function of the arguments of reset() and of
/// the steps since: bit for bit what a freshly made world computes (PHYSICS.md section 3).
class World {
 public:
  World(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene);
  ~World();
  World(const World&) = delete;

  /// Fixtures, the arm at q (at rest), and the objects of `present` at rest and asleep at their poses.
  void reset(const ObjectSet& present, const WorldState& state, const Eigen::VectorXd& q);

  /// Moves the arm linearly to q during one step of scene.physics.step seconds.
  void step(const Eigen::VectorXd& q);

  double time_s() const;  // since reset
  const ObjectSet& present() const;

  /// Of an object that is present: pose of its own frame, velocity of its centre of mass (m/s), angular
  /// velocity (rad/s), and whether it is awake. An object asleep has not moved in this step.
  Eigen::Isometry3d X_WO(ObjectId id) const;
  Eigen::Vector3d linear_velocity(ObjectId id) const;
  Eigen::Vector3d angular_velocity(ObjectId id) const;
  bool awake(ObjectId id) const;

  /// Bodies in contact after the last step. Kinematic or static bodies never pair with one another (the arm
  /// against fixtures and static immovables: ask collision).
  void contacts(std::vector<Contact>& out) const;

  /// From now on the object moves with the link, as robot (held). Its pose in the link is kept as it is.
  void attach(ObjectId id, LinkId link);
  /// From now on the arm passes through the object (the gripper closing on what it grasps).
  void ignore_arm(ObjectId id);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Object whose linear speed (m/s) and angular speed (rad/s) are below these for kRestSteps steps rests.
inline constexpr double kRestSpeed = 0.01;
inline constexpr double kRestAngularSpeed = 0.05;

}  // namespace mamo
