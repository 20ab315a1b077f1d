// Which configurations of an edge are looked at.
#pragma once

#include <vector>

namespace mamo::collision {

/// A stretch of an edge with its own sampling: samples begin + i (end - begin) / intervals for i = 0 .. intervals;
/// the last one belongs to the next stretch, unless there is none.
struct Stretch {
  double begin = 0, end = 1;  // of the edge parameter
  int intervals = 1;
  bool last = true;

  int samples() const { return intervals + (last ? 1 : 0); }
  double at(int i) const { return i == intervals ? end : begin + (end - begin) * (static_cast<double>(i) / intervals); }
};

}  // namespace mamo::collision
