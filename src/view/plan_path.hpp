// A plan as configurations of the whole group, per segment; where its objects end.
#pragma once

#include <map>
#include <vector>

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::view {

struct SegmentPath {
  SegmentKind kind;
  ObjectId object;
  std::vector<Eigen::VectorXd> q;  // group joints at the segment's points
};

/// Joints that a segment does not name keep their value; segments that do not fit the robot are left out.
std::vector<SegmentPath> segment_paths(const Problem& problem, const Plan& plan);

/// The last predicted pose of every object the plan lists.
std::map<ObjectId, Eigen::Isometry3d> final_poses(const Problem& problem, const Plan& plan);

}  // namespace mamo::view
