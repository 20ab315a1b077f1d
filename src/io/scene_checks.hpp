// What is wrong with a scene by geometry alone.
#pragma once

#include <vector>

#include "io/strict_reader.hpp"
#include "mamo/model/scene.hpp"

namespace mamo::io {

struct Place {
  int line = 0, column = 0;
};

/// Objects with nothing under them at the start: no other body, by their bounding boxes, reaches to within 5 mm
/// of the lowest point, and neither does the floor at z = 0. Never wrong about an object that stands on something.
/// Static bodies (fixtures, immovables without mass) may float. `places`: of the objects in the file, or empty.
void check_floating(const Scene& scene, const std::vector<Place>& places, bool only_warn, Complaints& complaints);

}  // namespace mamo::io
