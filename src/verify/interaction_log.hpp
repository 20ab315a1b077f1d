// Which pairs touched while one of the two moved because of the robot.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "mamo/model/interaction.hpp"
#include "mamo/physics/world.hpp"

namespace mamo::verify {

/// An object moves because of the robot when the robot, or an object that so moves, touches it. Resting contact does
/// not count, fixtures and the floor are no nodes.
class InteractionLog {
 public:
  explicit InteractionLog(const Scene& scene) : scene_(scene) {}
  void note(const World& world, const std::vector<Contact>& contacts, double time_s);
  /// Sorted by (first time, a, b).
  std::vector<Interaction> interactions() const;

 private:
  bool moved_by_robot(const World& world, ObjectId id) const;

  const Scene& scene_;
  std::set<ObjectId> caused_;
  std::map<std::pair<ObjectId, ObjectId>, double> first_;
};

}  // namespace mamo::verify
