// The task of generated retrieval problems.
#pragma once

#include "mamo/model/problem.hpp"

namespace mamo {

/// Fetch an object and bring it to the start configuration. The pre-grasp looks from about where the hand rests at home
/// to the object, turned by `turn` (rad), at a box then square on the nearest side; it is 0.045 m off the object, at
/// half its height.
Retrieve retrieve_task(const Problem& problem, ObjectId object, double turn);

}  // namespace mamo
