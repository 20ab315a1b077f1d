// Compartments open to the front, without anything in them.
#pragma once

#include <vector>

#include "mamo/model/problem.hpp"

namespace mamo {

/// Inside (m, world). The robot's base is at the origin, x forward, y left, z up; the front is open.
struct Compartment {
  double x[2], y[2];
  double floor, clear_height;
};

// The shelf of the published scenes, seen from above (m):
//
//      y -0.10 +----------------+
//              |                |
//   robot      | open    back   |     floor at z = 0.77, ceiling at 1.09
//   x = 0      |                |
//        -0.90 +----------------+
//            0.48             1.08 x
inline constexpr Compartment kShelf{{0.48, 1.08}, {-0.90, -0.10}, 0.77, 0.32};

/// Base, back, top, right and left, boards of 4 cm. Objects stand on the base; nobody touches the others (`legacy`:
/// objects may).
std::vector<Object> shelf_fixtures(const Compartment& inside, Profile profile);

}  // namespace mamo
