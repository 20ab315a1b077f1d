// RelevantObject of SelSim's Algorithm 2: which object outside C_R caused a violation.
#pragma once

#include <vector>

#include "mamo/model/interaction.hpp"
#include "mamo/model/scene.hpp"

namespace mamo {

/// Walks the tree of interactions breadth first from `violated` to the first object outside `relevant`.
/// Nodes are objects only; at equal depth the earlier contact comes first, then the smaller id. Returns
/// `violated` itself when it is not relevant yet, kNoObject when every object of the tree is relevant.
ObjectId relevant_object(const std::vector<Interaction>& interactions, ObjectId violated, const ObjectSet& relevant,
                         const Scene& scene);

}  // namespace mamo
