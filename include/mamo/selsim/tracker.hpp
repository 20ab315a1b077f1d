// TRACK of SelSim's Algorithm 2: a path of the projected space, replayed edge by edge with every object.
#pragma once

#include <optional>
#include <vector>

#include "mamo/lattice/edge_evaluator.hpp"

namespace mamo {

/// Outcome of tracking a path of joint configurations.
struct Track {
  bool ok = false;
  bool stopped = false;
  int failed_edge = -1;                   // index of the edge that was invalid
  std::optional<Violation> violation;     // of that edge
  std::vector<Interaction> interactions;  // P, accumulated over the path; times from the path's start
  bool second_order = false;
  int simulations = 0;
  TimedPath motion;                // of the edges that were valid, waits included
  std::vector<int> edge_of_point;  // edge that led to each point of `motion`
  std::vector<bool> touching;      // per valid edge: it was simulated, something was (nearly) touched
  std::vector<WorldState> states;  // objects at each point of the path, start included
  WorldState state;                // at the end
};

/// `path`: configurations, at least one. `bodies`: every object counts (make_relevant_bodies of all).
Track track(const Problem& problem, EdgeEvaluator& evaluator, const std::vector<Eigen::VectorXd>& path,
            const RelevantBodies& bodies, StopSource* stop);

}  // namespace mamo
