// The learned priority of E-M4M from data: which rearrangements led to a solution, and what densities they follow.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/em4m/priority.hpp"

namespace mamo {

/// One rearrangement, and whether the search from there alone found a plan.
struct TrainingPoint {
  RegionFeatures features;
  bool solved = false;
};

struct PriorityFit {
  PriorityParameters parameters;
  int points = 0, solved = 0;  // of the data
  int free = 0;                // points whose region was free: they count for the prior only
};

/// Maximum likelihood over the points that led to a solution and whose region is not free (the search takes a free
/// region first, whatever its density): a beta density of phi1, exponential ones of phi2 - 1 (where a region is not
/// free there is one at least; a shift changes no order) and of each phi3; the prior is the solved share of all points.
/// An error when fewer than 5 points are left or all have the same phi1.
Result<PriorityFit> fit_priority(const std::vector<TrainingPoint>& points);

/// {alpha, beta} of the beta density most likely to give the values, all in (0, 1); Newton's method on the two
/// equations psi(alpha) - psi(alpha + beta) = mean log x, psi(beta) - psi(alpha + beta) = mean log (1 - x).
std::pair<double, double> fit_beta(const std::vector<double>& values);

/// A file for `--config`: options of em4m by name. `about` stands above them, a comment of one or more lines.
std::string parameters_yaml(const PriorityParameters& parameters, const std::string& about);

/// Distribution functions of the three features, of the data and fitted, one under another.
std::string fit_svg(const std::vector<TrainingPoint>& points, const PriorityFit& fit);

}  // namespace mamo
