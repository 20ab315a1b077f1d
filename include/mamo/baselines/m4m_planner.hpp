// M4M (Saxena, Saleem, Likhachev 2021) behind `Planner`: the greedy predecessor of E-M4M. One solution of the path
// finding, one push sample of an object chosen at random, and the first valid push is committed to for good.
//
// No caches, no invalid goals, no search over rearrangements. What is ours: the path finding and the push sampler of
// E-M4M, and that a plan which verification rejects is cut back to the pushes that the replay carried out, whose
// outcome is taken from the replay.
#pragma once

#include <memory>
#include <vector>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

std::unique_ptr<Planner> make_m4m_planner();
std::vector<OptionDoc> m4m_options();

}  // namespace mamo
