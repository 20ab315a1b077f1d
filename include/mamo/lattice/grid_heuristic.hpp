// The 3-D breadth-first heuristic of SelSim (section VI): cells of the workspace between one point of the
// end effector and its goal, around what cannot be moved.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// A point fixed to the tip link that lies inside the robot's own geometry. A ball of `radius` around it is
/// robot, so that a cell whose every point is closer than that to an obstacle holds no valid state.
struct TrackedPoint {
  Eigen::Vector3d p_T{0, 0, 0};  // in the tip frame (m)
  double radius = -1;            // m; negative: no geometry is fixed to the tip, nothing is walled off
};
TrackedPoint tracked_point(const ForwardKinematics& kinematics);

/// Steps of a 26-connected flood over cubic cells from the goal region. Immutable after construction.
///
/// Consistency. A motion that moves the point by arc length l changes the distance by at most
/// floor(l / cell) + 1 cells (cut the arc into pieces shorter than a cell: each ends in the same or an adjacent
/// cell, and no cell on the way is a wall). With lever arms r_i >= the travel of the point per unit of joint i,
/// l <= sum r_i |dq_i| <= |r|_2 |dq|_2. cost_per_cell is the largest integer for which every primitive keeps
/// cost >= cost_per_cell * (floor(l / cell) + 1), and a motion onto the goal keeps cost >= h for
/// h = cost_per_cell * max(0, distance - 1).
class GridHeuristic {
 public:
  /// goal: centre of the goal region of the tracked point; goal_radius: its radius (m). `walls`: bodies that
  /// stay (fixtures, immovables). The grid covers what the point can reach.
  GridHeuristic(const ForwardKinematics& kinematics, const TrackedPoint& point, const Scene& scene,
                const ObjectSet& walls, const Eigen::Vector3d& goal, double goal_radius, double cell);

  /// Cells to the goal region; -1: walled off or outside the reach.
  int distance(const Eigen::Vector3d& p_W) const;
  double cell() const { return cell_; }
  std::size_t cells() const { return distance_.size(); }

 private:
  int index_of(const Eigen::Vector3d& p_W) const;
  void mark_walls(const Object& object, double radius);
  void flood(const Eigen::Vector3d& goal, double goal_radius);

  double cell_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i size_;
  std::vector<std::int16_t> distance_;
};

}  // namespace mamo
