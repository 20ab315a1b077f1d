// The interaction constraints as INTERFACE.md words them, read by verify for itself: given what a world shows after
// one step, the first thing that is wrong. Planners read them elsewhere (physics/evaluation), on purpose.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mamo/model/interaction.hpp"
#include "mamo/physics/world.hpp"
#include "verify/support.hpp"

namespace mamo::verify {

/// How the robot stands to the object that a retrieval is about.
enum class Grip { none, closing, holding };

class Constraints {
 public:
  Constraints(const Problem& problem, const ForwardKinematics& kinematics);

  /// The first violation after a step: touches in order of the pair, then penetration, then each object in order of
  /// id by tilt, speed, support, displacement. Objects asleep have not moved and are not asked again.
  std::optional<Violation> judge(const World& world, const std::vector<Contact>& contacts, Grip grip);

  /// The held object's pairs with what it stood on at the start are exempt until they were apart once.
  void track_clearing(const std::vector<Contact>& contacts, Grip grip);

  const std::set<std::pair<ObjectId, ObjectId>>& start_pairs() const { return start_pairs_; }
  const Support& support() const { return support_; }

  /// The contact with the held object counted as robot; a <= b by id value. Equal ids: robot with itself.
  Contact as_robot(Contact contact, Grip grip) const;

 private:
  std::optional<Violation> judge_touch(const Contact& raw, Grip grip) const;
  std::optional<Violation> judge_object(const World& world, ObjectId id,
                                        const std::vector<Eigen::Isometry3d>& X_WO) const;
  bool untouchable(ObjectId id, bool by_robot) const;
  /// Contacts that grasping brings with it: the gripper on the object, the held object on what it stands on.
  bool not_simulated(const Contact& raw, Grip grip) const;

  const Scene& scene_;
  ObjectId reach_target_ = kNoObject;  // of a reach task: nobody may touch it
  ObjectId retrieved_ = kNoObject;     // of a retrieve task
  std::set<std::pair<ObjectId, ObjectId>> start_pairs_;
  std::set<ObjectId> cleared_;  // what the held object has been apart from since the grasp
  Support support_;
  std::vector<Eigen::Vector3d> centre_;    // of mass in the object's frame, m
  std::vector<Eigen::Vector3d> p_start_;   // of the centre of mass in world, m
  std::vector<Eigen::Vector3d> up_;        // the object's own axis that is vertical at the start
};

}  // namespace mamo::verify
