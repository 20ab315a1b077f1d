// What each object stands on at the start, and whether it has left it: INTERFACE.md's reading of "support".
#pragma once

#include <Eigen/Geometry>

#include <set>
#include <utility>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::verify {

/// Pairs of bodies that touch at the start, by geometry: objects with objects and fixtures, and objects with links of
/// the robot that no group joint moves (then the first id is kRobot). first < second by id value.
std::set<std::pair<ObjectId, ObjectId>> pairs_in_contact(const Problem& problem, const ForwardKinematics& kinematics);

/// An object has left its support when its centre of mass is over none of the fixtures that may support it and not
/// over an object it stood on at the start, or lies below the top of the support it started on.
class Support {
 public:
  Support(const Scene& scene, const std::set<std::pair<ObjectId, ObjectId>>& touching);

  /// Metres the centre of mass is below or beside what may carry it; 0 while it is supported. X_WO: poses of all
  /// objects (of those it stood on, at least).
  double left_by(ObjectId id, const Eigen::Vector3d& centre_of_mass, const std::vector<Eigen::Isometry3d>& X_WO) const;

  /// Bodies the object stood on at the start.
  const std::vector<ObjectId>& stood_on(ObjectId id) const { return start_[id.index()].bodies; }

 private:
  /// What a shape covers seen from above.
  struct Footprint {
    std::vector<Eigen::Vector2d> outline;  // convex, counter-clockwise
    double bottom = 0;                     // m, the shape's lowest point
  };
  struct Start {
    std::vector<ObjectId> bodies;
    double top = 0;  // m, of the lowest thing it stood on; -infinity if it stood on nothing
  };
  static Footprint footprint(const PlacedShape& shape, const Eigen::Isometry3d& X_WO);
  static double outside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point);

  const Scene& scene_;
  std::vector<Start> start_;                      // per object
  std::vector<std::vector<Footprint>> fixtures_;  // per object; empty unless it is a fixture
};

}  // namespace mamo::verify
