// Options of the em4m planners, parsed from PlanOptions.
#pragma once

#include "mamo/em4m/priority.hpp"
#include "mamo/mapf/object_paths.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {

struct Em4mOptions {
  int attempts = 5;     // pushes tried per object and path
  int regions = 4;      // negative goal regions, of retrievals without movables by different grasps
  double patience = 0;  // what each further expansion of a vertex takes off its log priority
  int rejections = 3;   // retrievals of one vertex that verification may reject before it is expanded
  CollisionOptions collision;
  PushOptions push;
  RetrievalOptions retrieval;
  ObjectPathsOptions paths;
  PriorityParameters priority;

  OptionTable table();
};

}  // namespace mamo
