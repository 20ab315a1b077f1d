// The PR2 that the project ships, as generated problems use it.
#pragma once

#include "mamo/common/result.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// Fills robot, robot_files and q_start: right arm at home, torso 0.1, fingers open 0.2, left arm parked
/// (EM4M_FACTS section 8), self-collision pairs chosen.
Status install_shipped_pr2(Problem& problem, const std::string& tip);

}  // namespace mamo
