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

/// Two bodies that touch: some contact point of distance <= 0, or one that carries a force. a < b by id value,
/// kRobot and kFloor included; depth = the deepest penetration (m, >= 0), p_W where (world, m). Contacts come sorted
/// by (a, b), one per pair.
struct Contact {
  ObjectId a, b;
  double depth = 0;
  Eigen::Vector3d p_W{0, 0, 0};
};

/// One instance per worker. After reset() what follows is a pure function of the arguments of reset() and of
/// the calls since: bit for bit what a freshly made world computes, and objects that nothing comes near change
/// nothing by being present.
///
/// Bullet gives the shapes, the contact points and the sequential-impulse solver; the loop around them is ours,
/// so that bodies are visited in order of id, sleep until something that moves comes within a millimetre or two,
/// and nothing is kept that reset() does not clear. What falls asleep is put to the nearest quantised pose and its
/// contacts are forgotten: a motion among objects asleep gives the same bits whether it is simulated on its own or as a
/// part of a longer one. A floor at z = 0 (lower where the scene starts lower) catches what falls. Moving links are
/// kinematic: they push with whatever force it takes and are pushed by nothing.
/// Fixtures, still links and immovables without mass are static.
class World {
 public:
  /// The scene is copied as far as needed.
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
  /// Of an object that is asleep: where it is, exactly. A world reset to these poses goes on like this one.
  const QuantisedPose& rest_pose(ObjectId id) const;

  /// Bodies in contact after the last step. Kinematic or static bodies never pair with one another (the arm
  /// against fixtures and static immovables: ask collision).
  void contacts(std::vector<Contact>& out) const;

  /// From now on until reset() there is no contact between the robot and this object (a gripper closing on it).
  void ignore_robot(ObjectId id);
  /// As if something had come near: the object feels gravity and contacts until it has rested for kSleepTime.
  void wake(ObjectId id);
  /// From now on the object moves with the link, as robot (held). Its pose in the link is kept as it is.
  void attach(ObjectId id, LinkId link);

  /// Objects that took part in what happened since reset(): awake, or in reach of contact points. The others
  /// changed nothing by being present.
  const ObjectSet& took_part() const;
  /// Boxes (world, m) of all that moved since reset(), one per body, over all steps. An object asleep whose ball
  /// meets none of them changes nothing by being present.
  std::vector<Eigen::AlignedBox3d> swept() const;
  /// A ball in the object's frame that holds whatever of it contact points reach, wherever it rests.
  struct Ball {
    Eigen::Vector3d centre;  // m
    double radius;           // m
  };
  Ball ball(ObjectId id) const;

  /// Pairs of bodies (a < b, sorted; objects, fixtures and the floor, not the robot; at least one an object) of
  /// which `state` puts the surfaces closer than `tolerance` (m). Ends what reset() began: call reset() next.
  std::vector<std::pair<ObjectId, ObjectId>> touching(const WorldState& state, double tolerance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// An object that falls asleep closer than this to where it woke has not moved: it is put back there. m and rad
inline constexpr double kTrembleDistance = 1e-4;
inline constexpr double kTrembleAngle = 1e-3;

/// An object whose linear speed (m/s) and angular speed (rad/s) are below these for kRestTime (s) rests. The
/// world itself puts it to sleep, with all it touches, after kSleepTime (s) of rest away from the moving arm.
inline constexpr double kRestSpeed = 0.01;
inline constexpr double kRestAngularSpeed = 0.05;
inline constexpr double kRestTime = 0.1;
inline constexpr double kSleepTime = 0.5;

}  // namespace mamo
