// A plan's segments as one path of the whole planning group over one time axis.
#pragma once

#include <vector>

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::verify {

/// Made of a plan that has passed check_form(). Joints that a segment does not name keep their value.
struct Timeline {
  TimedPath path;               // group joints; every point of the plan, each segment's first one only for segment 0
  std::vector<int> segment_of;  // per point of the path: the segment whose motion ends there
  std::vector<double> begin_s, end_s;  // per segment

  double duration_s() const { return path.duration(); }
  /// The segment whose motion runs at a time (the earlier one at a boundary, the last one afterwards).
  int segment_at(double time_s) const;
};

Timeline make_timeline(const Problem& problem, const Plan& plan);

/// Index in the planning group of each joint a segment names; -1 for names that are not in the group.
std::vector<int> group_indices(const Robot& robot, const Segment& segment);

}  // namespace mamo::verify
