// A problem and a plan seen from above, as one self-contained SVG that reads well on light and dark pages.
#pragma once

#include <string>

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::view {

struct TopViewOptions {
  double width_px = 980;  // of the whole picture, legend included
  std::string title;      // empty: the problem's name
};

/// x to the right, y up, in metres of the world. Shows fixtures (those above the objects as outlines), objects by
/// kind, the arm at the start and, with a plan, at its end; the tip's path coloured by the kind of segment, and for each
/// object that the plan moves where it was (dashed) and where it goes. The plan must fit the problem (joint names of
/// the group); segments that do not are left out. A pure function of its arguments.
std::string top_view_svg(const Problem& problem, const Plan* plan = nullptr, const TopViewOptions& options = {});

}  // namespace mamo::view
