// What E-M4M shows of a query (--explain): regions, paths of objects, pushes that failed and why.
#pragma once

#include <vector>

#include "mamo/mapf/object_paths.hpp"
#include "mamo/model/planning_notes.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/push/push_planner.hpp"

namespace mamo {

class Em4mNotes {
 public:
  explicit Em4mNotes(const Problem& problem) : problem_(problem) {}

  void region(const VoxelVolume& region);
  void paths(int expansion, const std::vector<ObjectPath>& paths, const WorldState& state);
  void failed(int expansion, const ObjectPath& path, const PushOutcome& outcome, const WorldState& state);
  PlanningNotes take();

 private:
  const Problem& problem_;
  NoteLayer region_{
      "negative goal region", "what arm and object sweep on the way home; movables must be outside", {}, {}};
  NoteLayer paths_{"object paths", "where conflict-based search would have the objects go", {}, {}};
  NoteLayer failed_{"failed pushes", "pushes that came to nothing, where and why", {}, {}};
};

}  // namespace mamo
