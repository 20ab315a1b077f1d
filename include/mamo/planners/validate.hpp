// Is the problem itself sound? What needs a collision checker or inverse kinematics to be found out; the
// rest is io's. Everything here is an invalid input (exit 3), named in one line.
#pragma once

#include "mamo/common/result.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// The start configuration hits nothing (the robot itself, fixtures, objects), objects neither overlap by more
/// than kMaxStartOverlap nor float more than kMaxStartGap above what could carry them, and the goal pose has an
/// inverse-kinematics solution.
Status validate(const Problem& problem);

inline constexpr double kMaxStartOverlap = 0.002;  // m
inline constexpr double kMaxStartGap = 0.005;      // m

}  // namespace mamo
