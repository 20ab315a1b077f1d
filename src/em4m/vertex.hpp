// Vertices of the outer search: rearrangements of the movable objects, and how each came about.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mamo/common/job_board.hpp"
#include "mamo/em4m/priority.hpp"
#include "mamo/mapf/object_paths.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {

/// A push that somebody executed, for the object and the goal that it was meant for.
struct PushStep {
  ObjectId object = kNoObject;
  GridCell goal;
  std::shared_ptr<const PushOutcome> push;
};

/// Two rearrangements of one class are duplicates: every object within the same bins of 1 cm and about 5 degrees
/// (rotation about its own axis aside, if the object is symmetric about it).
using RearrangementClass = std::vector<std::int32_t>;
RearrangementClass class_of(const Scene& scene, const std::vector<ObjectId>& movables, const WorldState& state);

/// Names a rearrangement by its content.
std::uint64_t content_hash(const std::vector<ObjectId>& movables, const WorldState& state);

struct Vertex {
  int number = 0;  // in order of creation
  Vertex* parent = nullptr;
  PushStep step;  // from the parent; none at the root
  int pushes = 0;
  int region = 0;  // index of the negative goal region that this vertex is to clear
  WorldState state;
  std::vector<ObjectLoad> loads;  // by object id
  Priority promise{};             // f(v)
  Priority priority{};            // f(v), less what expansions in vain have cost it

  // What expansions found out (kappa of Algorithm 1).
  std::map<ObjectId, InvalidGoals> invalid;
  std::vector<std::pair<ObjectId, GridCell>> valid_goals;  // of valid pushes, not in `invalid` yet
  bool news = true;                                        // `invalid` has grown since the last call
  int expansions = 0;
  bool refuted = false;  // the replay of its last push came out otherwise

  // Retrieval against all objects, computed ahead.
  JobBoard::Handle retrieval_job;
  std::shared_ptr<RetrievalOutcome> retrieval;
  bool retrieval_tried = false;
};

/// OPEN: most promising first, then more pushes, then older.
struct MorePromising {
  bool operator()(const Vertex* a, const Vertex* b) const {
    if (a->priority != b->priority) return a->priority > b->priority;
    if (a->pushes != b->pushes) return a->pushes > b->pushes;
    return a->number < b->number;
  }
};

}  // namespace mamo
