// Dogar and Srinivasa's planning backwards in time (2012) behind `Planner`, as E-M4M's comparison has it: what is in
// the way of the retrieval is pushed away last, what is in the way of that push before it, and so on.
//
// The negative goal region grows with every push by what the arm and the pushed object sweep. An object found inside
// is pushed straight to a random place outside; the push counts if the object ends fully outside. While it is
// simulated, objects planned already stand where they stood at the start (they are moved later), all others are set
// aside: those in the region will have been moved by then, and those that the push would touch join them.
// What is ours: random places are drawn until the object as it stands fits there (the papers look at one cell); each
// draw has a budget of attempts; the push sampler is that of E-M4M.
#pragma once

#include <memory>
#include <vector>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

std::unique_ptr<Planner> make_dogar_planner();
std::vector<OptionDoc> dogar_options();

}  // namespace mamo
