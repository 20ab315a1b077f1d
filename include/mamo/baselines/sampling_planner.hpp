// RRT and KPIECE of OMPL (Sucan, Moll, Kavraki 2012) behind `Planner`, as E-M4M's comparison has them: geometric
// planners with the library's defaults over arm configurations, object poses carried along.
//
// A step is a straight joint motion, judged by the same evaluation as everywhere: free of contact, or simulated with
// every object. RRT drops a step that hits what it must not; KPIECE keeps the part before. The goal: a configuration
// from which the pre-grasp, the grasp and the way home hold in simulation; the ways to fetch the object are those of
// the retrieval planner without movable objects. One thread. Every generator is seeded by the query, so that results
// repeat, in one process too.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

enum class SamplingAlgorithm { rrt, kpiece };

std::unique_ptr<Planner> make_sampling_planner(SamplingAlgorithm algorithm);
std::vector<OptionDoc> sampling_options();

}  // namespace mamo
