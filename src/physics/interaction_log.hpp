// Who touched whom because of the robot, during one motion (ALGORITHMS.md, "The interaction tree").
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mamo/model/interaction.hpp"
#include "mamo/physics/world.hpp"

namespace mamo {

/// A pair counts when the two touch and one of them moves because of the robot: is the robot, or was touched by the
/// robot or by something that counts as moving, and is displaced or fast (kMovedDistance, kMovedSpeed). Contact
/// with fixtures and the floor does not count; nor does rest.
class InteractionLog {
 public:
  explicit InteractionLog(const Scene& scene);

  /// Forgets everything; displacement is measured from `state`.
  void begin(const WorldState& state);
  /// What the world shows after a step that ended at time_s.
  void note(const World& world, const std::vector<Contact>& contacts, double time_s);

  /// The robot or something that moved because of it has touched the object.
  bool influenced(ObjectId id) const { return influenced_[id.index()]; }
  /// Sorted by (first time, a, b).
  const std::vector<Interaction>& interactions() const { return interactions_; }

 private:
  bool moves(const World& world, ObjectId id) const;
  bool is_node(ObjectId id) const { return id == kRobot || (id.valid() && !fixture_[id.index()]); }

  std::vector<bool> fixture_;                // by object
  std::vector<Eigen::Vector3d> centre_;      // of mass, in the object's frame (m)
  std::vector<Eigen::Vector3d> begin_;       // of mass, in world, when influenced first (m)
  WorldState from_;
  std::vector<bool> influenced_;
  std::vector<Interaction> interactions_;
};

}  // namespace mamo
