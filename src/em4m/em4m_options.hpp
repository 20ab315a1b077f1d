// Options of the em4m planners, parsed from PlanOptions.
#pragma once

#include "mamo/em4m/priority.hpp"
#include "mamo/mapf/object_paths.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {

struct Em4mOptions {
  int attempts = 5;    // pushes tried per object and path
  int regions = 4;     // retrievals without movables that compete to be the negative goal region
  int rejections = 3;  // retrievals of one vertex that verification may reject before it is expanded
  CollisionOptions collision;
  PushOptions push;
  RetrievalOptions retrieval;
  ObjectPathsOptions paths;
  PriorityParameters priority;

  OptionTable table();
};

}  // namespace mamo
