// What was understood of a file, as text for `mamo info`.
#pragma once

#include <string>

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::view {

/// Several lines, each ended by a newline. Angles in radians, lengths in metres.
std::string describe(const Robot& robot);
std::string describe(const Problem& problem);
std::string describe(const Plan& plan, const Problem& problem);

}  // namespace mamo::view
