// What can be said of a plan without moving anything: its form, its start, its continuity, joint limits, velocities.
#pragma once

#include <vector>

#include "mamo/model/planner.hpp"

namespace mamo::verify {

/// Well formed: at least one segment and point, known and unrepeated joints of the group, one value per joint,
/// finite numbers, times that start at 0 and increase, objects that exist, and for a retrieval one grasp of the
/// object asked for. At most one finding per segment. A plan that fails cannot be looked at further.
std::vector<Verdict::Finding> check_form(const Problem& problem, const Plan& plan);

/// Start, continuity between segments, joint limits and velocities of a well-formed plan; the worst of each kind
/// per segment.
std::vector<Verdict::Finding> check_joints(const Problem& problem, const Plan& plan);

/// The segment that grasps: the first one of kind grasp in a retrieval; -1 where nothing is grasped.
int grasp_segment(const Problem& problem, const Plan& plan);

inline constexpr double kSameValue = 1e-6;  // rad or m: two joint values that are one

}  // namespace mamo::verify
