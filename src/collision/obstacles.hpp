// The objects and fixtures of a scene where a state puts them, plain and padded.
#pragma once

#include <vector>

#include "solid.hpp"

#include "mamo/model/scene.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo::collision {

/// One shape of one object. Parts are in order of object id.
struct ObstaclePart {
  ObjectId object;
  Solid plain, padded;
  Eigen::Isometry3d X_OS, X_OP;  // frames of the plain and of the padded solid (they differ for a hull)
  Placed X_WS, X_WP;
  Eigen::Vector3d half_box_plain = Eigen::Vector3d::Zero(), half_box_padded = Eigen::Vector3d::Zero();
};

class Obstacles {
 public:
  Obstacles(const Scene& scene, double padding);

  /// Re-poses the objects whose pose differs.
  void set_state(const WorldState& state);

  const std::vector<ObstaclePart>& parts() const { return parts_; }
  /// Index of the first part of an object; of one past the last object for scene.size().
  std::size_t first_part(std::size_t object) const { return first_[object]; }

 private:
  void place(std::size_t object);

  std::vector<ObstaclePart> parts_;
  std::vector<std::size_t> first_;
  WorldState state_;
};

/// Pairs a < b of objects, not both fixtures, that overlap by more than `tolerance` (m).
std::vector<std::pair<ObjectId, ObjectId>> overlaps(const Scene& scene, const Obstacles& obstacles, double tolerance);

}  // namespace mamo::collision
