// Options of the selective-simulation planners, parsed from PlanOptions.
#pragma once

#include "mamo/lattice/lattice_options.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

struct SelSimOptions {
  double weight = 100;               // when --weight is not given
  std::string immovables = "known";  // known | discovered (ALGORITHMS.md, "What the search knows")
  int max_iterations = 200;          // planning iterations
  int round_expansions = 7;          // of a search before the lattice gets more goals and chains; doubles each time
  LatticeOptions lattice;

  /// The table bound to this object; docs() shows the values it holds now.
  OptionTable table();
};

}  // namespace mamo
