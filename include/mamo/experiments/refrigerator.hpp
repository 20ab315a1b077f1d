// Seeded retrieval problems like those on the robot of the E-M4M paper ("Real-World Experiments").
#pragma once

#include <cstdint>

#include "mamo/common/result.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

struct RefrigeratorSpec {
  std::uint64_t seed = 1;
  int index = 0;  // of the problem among those of this seed; a problem does not depend on how many are made
  Profile profile = Profile::full;
};

/// The shipped PR2 before a compartment 0.60 m wide, 0.45 m deep and 0.32 m high, in it five objects of the YCB set as
/// in the paper's Figure 1: the tomato soup can to fetch behind the coffee can (002) and the potted meat can, a mustard
/// bottle and a sugar box beside. The paper names three of the five and no numbers; the others, the compartment's
/// size and the places are ours. Each problem is a perturbation: places within 3 cm each way, headings within 0.4 rad,
/// masses and frictions within a tenth of household_items().
///
/// Drawn again until the can could be retrieved if nothing else were there, and something is in the way of it.
/// `generated` holds generator, seed, index, difficulty, movables_in_the_way, scene_redraws. name and path are
/// "refrigerator-<seed>-<index>.yaml". Errors: usage (a negative index).
Result<Problem> generate_refrigerator(const RefrigeratorSpec& spec);

}  // namespace mamo
