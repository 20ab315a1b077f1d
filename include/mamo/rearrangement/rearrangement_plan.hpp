// A whole plan from its parts: pushes, each from and to the arm's resting configuration, then the retrieval.
#pragma once

#include <utility>
#include <vector>

#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {

/// Segments of one push in a plan: approach, push, retreat.
inline constexpr int kSegmentsPerPush = 3;

/// Timed from rest to rest as planning simulated it, waits included. objects_after is left empty: the replay says it.
Plan rearrangement_plan(const Problem& problem, const std::vector<std::pair<ObjectId, const PushOutcome*>>& pushes,
                        const RetrievalPath& retrieval);

}  // namespace mamo
