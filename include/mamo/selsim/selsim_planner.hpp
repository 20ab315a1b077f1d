// Planning with selective simulation (Saleem, Likhachev 2020, Algorithms 1 and 2) and, with every object
// relevant from the start, its non-selective counterpart.
#pragma once

#include <memory>
#include <string>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

/// The cost in a result is the length of the plan that is returned (milliradians), smoothed or not. The bound was
/// proven for the cost of the path that the search found, which is no smaller, so it holds for the plan: length <=
/// bound x the cheapest path of the lattice, length and contact_cost together. The four planners of the paper's Table
/// I.
struct SelSimVariant {
  std::string name = "selsim";
  bool selective = true;  // false: C_R is all objects from the start
  bool lazy = true;       // lazy weighted A*; false: weighted A*
};

std::unique_ptr<Planner> make_selsim_planner(const SelSimVariant& variant);
/// Options that `set` understands, with defaults.
std::vector<OptionDoc> selsim_options();

}  // namespace mamo
