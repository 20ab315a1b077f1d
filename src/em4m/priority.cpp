#include "mamo/em4m/priority.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mamo {

void PriorityParameters::add_to(OptionTable& table) {
  const double most = 1e6;
  table.add("priority_prior", prior, 1e-9, 1.0, "P(E) of the learned priority");
  table.add("priority_phi1_alpha", phi1_alpha, 1e-6, most, "alpha of its beta density of the region's filled share");
  table.add("priority_phi1_beta", phi1_beta, 1e-6, most, "beta of that density");
  table.add("priority_phi2_rate", phi2_rate, 1e-6, most, "rate of its density of the number of objects in the region");
  table.add("priority_phi3_rate", phi3_rate, 1e-6, most,
            "rate of its density of mass times friction times share inside");
  table.add("priority_phi3_relative", phi3_relative,
            "take that density relative to its largest value: one more object inside is never more promising");
}

ObjectLoad object_load(const VoxelVolume& region, const Object& object, const Eigen::Isometry3d& X_WO) {
  const VoxelVolume::Overlap overlap = region.overlap(object, X_WO);
  ObjectLoad load;
  load.cells = overlap.common_cells;
  if (overlap.object_cells > 0)
    load.share = static_cast<double>(overlap.common_cells) / static_cast<double>(overlap.object_cells);
  load.weighted_share = load.share * object.mass * object.friction;
  return load;
}

RegionFeatures region_features(const VoxelVolume& region, const std::vector<ObjectLoad>& loads) {
  RegionFeatures features;
  std::int64_t cells = 0;
  for (const ObjectLoad& load : loads) {
    if (load.cells == 0) continue;
    cells += load.cells;
    ++features.phi2;
    features.phi3.push_back(load.weighted_share);
  }
  if (region.count() > 0) features.phi1 = static_cast<double>(cells) / static_cast<double>(region.count());
  return features;
}

Priority learned_priority(const RegionFeatures& features, const PriorityParameters& p) {
  if (features.phi2 == 0) return {std::numeric_limits<double>::infinity(), 0, 0};
  const double phi1 = std::clamp(features.phi1, 1e-12, 1 - 1e-12);
  double log_f = std::log(p.prior);
  log_f += (p.phi1_alpha - 1) * std::log(phi1) + (p.phi1_beta - 1) * std::log1p(-phi1) -
           (std::lgamma(p.phi1_alpha) + std::lgamma(p.phi1_beta) - std::lgamma(p.phi1_alpha + p.phi1_beta));
  log_f += std::log(p.phi2_rate) - p.phi2_rate * features.phi2;
  for (double phi3 : features.phi3) log_f += (p.phi3_relative ? 0 : std::log(p.phi3_rate)) - p.phi3_rate * phi3;
  return {log_f, 0, 0};
}

Priority lexicographic_priority(const RegionFeatures& features) {
  return {-features.phi1, -static_cast<double>(features.phi2),
          -std::accumulate(features.phi3.begin(), features.phi3.end(), 0.0)};
}

}  // namespace mamo
