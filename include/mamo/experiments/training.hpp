// Data for the learned priority of E-M4M ("Learned Priority Function"): problems from rearrangements, each tried alone.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/experiments/priority_fit.hpp"
#include "mamo/experiments/shelf.hpp"

namespace mamo {

/// Counted, not timed, so that a run repeats: the paper's 10 min and 60 s are budgets of expansions and simulations
/// here.
struct TrainingSpec {
  int scenes = 27;    // generated shelves: 5, 10 and 15 movables in turn; easy, medium and hard in turn
  int vertices = 40;  // of each scene at most: those that the breadth-first run made, evenly spaced
  std::uint64_t seed = 1000;
  std::int64_t collect_expansions = 60, collect_simulations = 600;  // of a breadth-first run
  /// Of a depth-first run. Small: with much effort nearly every rearrangement leads to a plan, and the data say little.
  std::int64_t try_expansions = 6, try_simulations = 25;
  int jobs = 1;                            // problems side by side; changes nothing but time
  std::map<std::string, std::string> set;  // options of em4m
};

/// Shelf k of the training problems. Its file would be number k / 9 of its setting and the seed.
ShelfSpec training_shelf(const TrainingSpec& spec, int k);

/// Runs E-M4M breadth first on each scene (one region, no retrieval), then depth first on every rearrangement that it
/// made, as a problem of its own; a point is solved when a plan was found (not verified). In order of scenes and
/// rearrangements. progress(scene, points so far) is called on the caller's thread. Ends early when `stop` fires.
/// Errors: of a generator.
Result<std::vector<TrainingPoint>> training_points(const TrainingSpec& spec, StopSource& stop,
                                                   const std::function<void(int, int)>& progress);

}  // namespace mamo
