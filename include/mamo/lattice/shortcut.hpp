// Smoothing: contact-free stretches of a path are replaced by straight motions that touch nothing either.
#pragma once

#include <vector>

#include "mamo/lattice/edge_evaluator.hpp"

namespace mamo {

/// `touching[k]` says whether edge k (from path[k] to path[k + 1]) touched an object; such edges are kept as
/// they are. Greedy from the front, farthest reachable point first; no randomness. `states[k]`: objects at
/// path[k]. The result visits the same contacts from the same states.
std::vector<Eigen::VectorXd> shortcut(const std::vector<Eigen::VectorXd>& path, const std::vector<bool>& touching,
                                      const std::vector<WorldState>& states, EdgeEvaluator& evaluator,
                                      const RelevantBodies& bodies, StopSource* stop);

}  // namespace mamo
