// Seeded retrieval problems like those of the E-M4M paper ("Experimental Analysis"): fetch one of many things out of a
// shelf.
#pragma once

#include <cstdint>
#include <optional>

#include "mamo/common/result.hpp"
#include "mamo/experiments/difficulty.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

struct ShelfSpec {
  int movable = 10;
  int immovable = 4;  // obstacles; the object to fetch comes on top
  std::uint64_t seed = 1;
  int index = 0;  // of the problem among those of this seed; a problem does not depend on how many are made
  Profile profile = Profile::full;
  std::optional<Difficulty> difficulty;  // draw until it fits
};

/// The shipped PR2 (torso 0.1 m, right arm at home) before the shelf of the published scenes (floor at z = 0.77 m, 0.60
/// m deep, 0.80 m wide, 0.32 m high); boxes and cylinders of the published distribution upright on its floor, wholly
/// inside, without overlap: sides max(0.06, U(0, 0.16)) m, boxes max(0.18, U(0, 0.31)) m high, radii max(0.03, U(0,
/// 0.08)) m, cylinders max(0.15, U(0, 0.20)) m high, masses U(0, 0.5) kg, friction U(0.8, 1.2), any heading. The
/// pre-grasp of r_gripper_finger_dummy_planning_link looks from about the hand at home to the object (within 0.5 rad;
/// at a box: square on a side), 0.045 m off it, at half its height.
///
/// What cannot be retrieved even without the movables is drawn again, and so is what is not of the difficulty asked
/// for: the movables a few times, then the whole scene. `generated` holds generator, seed, index, movable, immovable,
/// difficulty, movables_in_the_way and scene_redraws (both kinds together). name and path are
/// "shelf-<seed>-<index>.yaml". Errors: usage (counts out of range, no room, no problem of that difficulty).
Result<Problem> generate_shelf(const ShelfSpec& spec);

}  // namespace mamo
