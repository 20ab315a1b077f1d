#include "mamo/rearrangement/rearrangement_query.hpp"

namespace mamo {

void RearrangementOptions::add_to(OptionTable& t) {
  t.add("attempts", attempts, 1, 1000, "pushes tried per object and path");
  t.add("regions", regions, 1, 100, "negative goal regions, of retrievals without movables by different grasps");
  t.add("rejections", rejections, 1, 100, "retrievals of one rearrangement that verification may reject");
  t.add("grasps", retrieval.grasps, 1, 10000, "grasp poses drawn around the given pre-grasp");
  t.add("grasp_solutions", retrieval.solutions, 1, 100, "inverse-kinematics solutions per grasp pose");
  t.add("lift", retrieval.lift, 0.0, 1.0, "height by which the object is lifted before it is drawn out (m)");
  t.add("max_object_tilt_deg", retrieval.max_object_tilt_deg, 0.0, 180.0, "tilt of the held object on the way home");
  t.add("retrieval_nodes", retrieval.max_nodes, 1, 10'000'000, "tree nodes of each search of a retrieval");
  t.add("region_cell", retrieval.cell, 0.002, 0.1, "edge of a cell of the negative goal region (m)");
  t.add("grid_cell", paths.cell, 0.002, 0.1, "edge of a cell of the objects' grid (m)");
  t.add("path_suboptimality", paths.suboptimality, 1.0, 100.0, "suboptimality factor of conflict-based search");
  t.add("standoff", push.standoff, 0.0, 0.5, "distance of the tip from the object where a push starts (m)");
  t.add("push_noise", push.noise, 0.0, 0.5, "standard deviation of push starts and waypoints (m)");
  t.add("push_height", push.height, 0.0, 0.5, "height of the tip above the support while pushing (m)");
  t.add("push_pitch_deg", push.pitch_deg, -90.0, 90.0, "pitch of the tip while pushing, nose down");
  t.add("overshoot", push.overshoot, 0.0, 0.5, "length of a push beyond the end of its path (m)");
  t.add("straight", push.straight, "push along one straight segment instead of the shortcut path");
  t.add("approach_nodes", push.approach_nodes, 1, 10'000'000, "tree nodes of the search for an approach");
}

}  // namespace mamo
