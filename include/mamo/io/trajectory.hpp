// A plan as one trajectory for other programs: the segments joined, time increasing from 0, never re-timed.
// Joints that a segment does not name keep their value. Motion is linear between the points.
#pragma once

#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::io {

/// The whole plan in one row of points: t[0] == 0, t strictly increasing.
struct JoinedPlan {
  std::vector<std::string> joint_names;  // group joints first, then others that a segment names
  TimedPath motion;
};
/// Fails when the plan is empty, or a segment does not start where the one before it ended (1e-6 rad or m).
Result<JoinedPlan> join_segments(const Plan& plan, const Problem& problem);

/// Header line `time,<joint>,...` (s; rad or m), then one line per point.
Result<std::string> trajectory_csv(const Plan& plan, const Problem& problem);

/// trajectory_msgs/JointTrajectory (FORMATS section 6): positions only, so that a controller interpolates
/// linearly. Times as {sec, nanosec}, or {secs, nsecs} for ROS 1. The predicted object poses follow as comments.
Result<std::string> joint_trajectory_yaml(const Plan& plan, const Problem& problem, bool ros1 = false);

}  // namespace mamo::io
