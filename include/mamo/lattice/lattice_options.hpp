// What shapes the manipulation lattice. Documented names and defaults; the planners expose them by name.
#pragma once

#include "mamo/collision/collision_checker.hpp"
#include "mamo/lattice/goal_chain.hpp"

namespace mamo {

struct LatticeOptions {
  double joint_resolution_deg = 1.0;         // bin of a revolute joint (deg)
  double prismatic_resolution = 0.01;        // bin of a prismatic joint (m)
  double long_step_deg = 20.0;               // long primitive, each joint alone, both ways
  double short_step_deg = 4.0;               // short primitive, near the start or the goal
  double short_distance = 0.15;              // m of heuristic distance within which short primitives act
  double tip_step = 0.15;                    // m, of the tip along its own axes at fixed orientation; 0: no tip steps
  double tip_turn_deg = 25.0;                // of the tip about its own axes (deg)
  double orientation_share = 0.15;           // of the heuristic of a pose goal, the rest is the grid's
  int goal_configurations = 12;              // inverse-kinematics solutions that snap motions aim at
  int snaps = 3;                             // nearest goal configurations tried from a state
  double own_snap_distance = 0.2;            // m of heuristic distance within which a state tries its own solution
  double extend_step_deg = 25.0;             // multi-joint step towards a goal configuration (length in joint space)
  int extends = 2;                           // nearest goal configurations stepped towards; 0: none
  double heuristic_cell = 0.03;              // m
  double object_position_resolution = 0.01;  // m, of the class of a state
  double object_angle_resolution_deg = 5.0;
  bool exact_objects = false;  // class = exact key
  GoalChainOptions chains;
  double contact_cost = 1;  // rad, of an action that touches relevant objects, on top of its length; 0: none
  bool memo = true;         // outcomes of physics are kept for the whole query
  int joins = 1;            // chains that a state may join, the nearest ones (the start: all)
  CollisionOptions collision;
};

}  // namespace mamo
