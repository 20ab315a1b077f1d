// The goal of a reach task as the lattice needs it: a test, a workspace region, configurations to snap to.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/lattice/edge_evaluator.hpp"
#include "mamo/lattice/grid_heuristic.hpp"
#include "mamo/lattice/lattice_options.hpp"

namespace mamo {

/// Immutable. Depends on the robot, the task, the bodies that stay and the seed, never on movables.
struct ReachGoal {
  Task task;                                    // ReachPose or ReachJoints
  std::vector<Eigen::VectorXd> configurations;  // collision-free against `walls`, in order of discovery
  bool ik_budget_used_up = false;               // fewer than asked for were found within the budget
  int rejected_in_collision = 0;                // solutions that hit themselves or a wall
  Eigen::Vector3d p_W{0, 0, 0};                 // centre of the tracked point's goal region (m)
  double radius = 0;                            // of that region (m)
};

/// Draws the goal configurations. `walls`: bodies the arm may not touch wherever they stand (start poses).
ReachGoal make_reach_goal(const Problem& problem, const ForwardKinematics& kinematics, const TrackedPoint& point,
                          CollisionChecker& checker, const ObjectSet& walls, std::uint64_t seed, int count);

/// Does the configuration fulfil the task (tolerances of the task)?
bool reaches(const ReachGoal& goal, const ForwardKinematics& kinematics, const Eigen::VectorXd& q);

}  // namespace mamo
