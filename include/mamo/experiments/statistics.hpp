// Statistics of runs in which a failure counts as a failure: it is never dropped from a percentile or a PAR2.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mamo/experiments/record.hpp"

namespace mamo {

/// The smallest value that at least `share` (0 to 1) of the values do not exceed (nearest rank); infinities are values.
/// NaN when there are none.
double percentile(std::vector<double> values, double share);

/// Wilson's 95 % interval of a rate.
std::array<double, 2> wilson_interval(int successes, int n);

/// Runs of one planner on one setting.
struct Summary {
  int n = 0, solved = 0, found = 0;
  int first_goal = 0;  // solved, of those whose first goal and scene were kept: what was redrawn counts as not solved
  double rate = 0;
  std::array<double, 2> rate_ci{0, 0};
  double mean_solved = 0;               // s, over the solved; NaN when there are none
  double mean_at_limit = 0;             // s, the unsolved at their time limit
  double par2 = 0;                      // s, the unsolved at twice their time limit
  std::array<double, 4> percentiles{};  // s, 25/50/75/95 of all runs; an unsolved run took infinitely long
  double simulations = 0, tracking = 0, expansions = 0, iterations = 0, relevant = 0;  // means over all runs
};
Summary summarise(std::span<const Record* const> runs);

/// Two planners on the problems (and seeds) that both solved.
struct Comparison {
  int both = 0;
  int only_first = 0, only_second = 0, neither = 0;
  double simulations = 0;    // of the second / of the first, sum over sum, used by the search; NaN: none to divide by
  double with_tracking = 0;  // the same with the simulations for tracking
  double time = 0;           // sum over sum
};
Comparison compare(std::span<const Record* const> first, std::span<const Record* const> second);

}  // namespace mamo
