// The selective-simulation planners on retrieval problems too: reach a pre-grasp by their search, then fetch.
//
// Where this is less than the letter of the comparison (ALGORITHMS.md, "SelSim on retrieve"): the lattice is searched
// up to the pre-grasp only, for one grasp after another, the target being untouchable, with a budget of expansions that
// doubles from round to round. Reach and extraction follow, for each grasp, the retrieval that holds without movable
// objects; simulation with every object (hence with all of C_R) judges whether they hold, pushes included. C_R grows
// anew for each grasp, and a plan that fails after the pre-grasp drops the grasp instead of teaching the search.
// `primitives: single` leaves one joint per motion, but for the snap onto the pre-grasp configuration.
#pragma once

#include <memory>
#include <vector>

#include "mamo/selsim/selsim_planner.hpp"

namespace mamo {

/// Solves reach tasks as make_selsim_planner(variant) does.
std::unique_ptr<Planner> make_selsim_with_retrieval(const SelSimVariant& variant);
std::vector<OptionDoc> selsim_with_retrieval_options();

}  // namespace mamo
