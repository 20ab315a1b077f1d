// Options of the em4m planners, parsed from PlanOptions.
#pragma once

#include "mamo/em4m/priority.hpp"
#include "mamo/rearrangement/rearrangement_query.hpp"

namespace mamo {

struct Em4mOptions {
  RearrangementOptions rearrangement;
  double patience = 0.3;  // what each further expansion of a vertex takes off its log priority
  PriorityParameters priority;

  OptionTable table() {
    OptionTable t;
    rearrangement.add_to(t);
    t.add("patience", patience, 0.0, 1e6, "what each further expansion of a rearrangement takes off its log priority");
    priority.add_to(t);
    return t;
  }
};

}  // namespace mamo
