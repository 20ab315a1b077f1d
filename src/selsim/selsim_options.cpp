#include "selsim/selsim_options.hpp"

#include "mamo/selsim/selsim_planner.hpp"

namespace mamo {

OptionTable SelSimOptions::table() {
  OptionTable t;
  LatticeOptions& l = lattice;
  t.add("immovables", immovables, {"known", "discovered"},
        "whether the search knows the immovable objects from the start or finds them like the others");
  t.add("max_iterations", max_iterations, 1, 1000000, "planning iterations before giving up");
  t.add("round_expansions", round_expansions, 1, 1000000000,
        "expansions of a search before it begins anew with more goals and chains; doubles each time");
  t.add("joint_resolution_deg", l.joint_resolution_deg, 0.01, 45, "bin of a revolute joint (deg)");
  t.add("prismatic_resolution", l.prismatic_resolution, 1e-5, 0.5, "bin of a prismatic joint (m)");
  t.add("long_step_deg", l.long_step_deg, 0.1, 90, "long primitive, one joint at a time (deg)");
  t.add("short_step_deg", l.short_step_deg, 0.1, 90, "short primitive, near the start and the goal (deg)");
  t.add("short_distance", l.short_distance, 0, 10, "where short primitives act: distance to start or goal (m)");
  t.add("tip_step", l.tip_step, 0, 1, "step of the tip along its own axes, orientation kept (m); 0: none, nor turns");
  t.add("tip_turn_deg", l.tip_turn_deg, 0.1, 90, "turn of the tip about its own axes (deg)");
  t.add("orientation_share", l.orientation_share, 0, 1, "of the heuristic, the rest being the grid's");
  t.add("goal_configurations", l.goal_configurations, 1, 1000, "inverse-kinematics solutions that snaps aim at");
  t.add("snaps", l.snaps, 0, 1000, "snaps tried from a state, to the nearest goal configurations");
  t.add("own_snap_distance", l.own_snap_distance, 0, 10,
        "where a state also snaps onto the inverse-kinematics solution found from itself: distance to goal (m)");
  t.add("extends", l.extends, 0, 1000, "steps tried from a state towards the nearest goal configurations");
  t.add("extend_step_deg", l.extend_step_deg, 0.1, 360, "length of such a step (deg)");
  t.add("chains", l.chains.chains, 0, 100,
        "seeded RRT-Connect paths among fixtures and immovables that states may join");
  t.add("contact_cost", l.contact_cost, 0, 1e6,
        "cost of an action that touches relevant objects, on top of its length (rad); 0: simulate as they come");
  t.add("memo", l.memo, "outcomes of physics are kept for all planning iterations; changes counts and time only");
  t.add("joins", l.joins, 0, 100, "nearest chains that a state may join (the start may join all)");
  t.add("chain_nodes", l.chains.max_nodes, 2, 1000000, "budget of each such path, in tree nodes");
  t.add("heuristic_cell", l.heuristic_cell, 0.005, 0.5, "cell of the breadth-first heuristic (m)");
  t.add("object_position_resolution", l.object_position_resolution, 1e-6, 1, "of a state's class (m)");
  t.add("object_angle_resolution_deg", l.object_angle_resolution_deg, 1e-3, 180, "of a state's class (deg)");
  t.add("exact_objects", l.exact_objects, "duplicates only when object poses are exactly equal");
  t.add("edge_step", l.collision.edge_step, 1e-4, 0.1, "arm motion between two collision checks (m)");
  t.add("padding", l.collision.padding, 0, 0.1, "inflation of objects when an edge is classified (m)");
  return t;
}

std::vector<OptionDoc> selsim_options() { return SelSimOptions{}.table().docs(); }

}  // namespace mamo
