// How promising a rearrangement is: E-M4M's learned priority ("Learned Priority Function"), and the lexicographic one
// of the ablation Tiebreak.
#pragma once

#include <array>
#include <compare>
#include <string>
#include <vector>

#include "mamo/collision/voxel_volume.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo {

/// How an object stands in the negative goal region.
struct ObjectLoad {
  double share = 0;           // of the object's volume inside the region (0 to 1)
  std::int64_t cells = 0;     // of the region that it fills
  double weighted_share = 0;  // share * mass (kg) * friction
};
ObjectLoad object_load(const VoxelVolume& region, const Object& object, const Eigen::Isometry3d& X_WO);

/// The features of the paper. phi1: share of the region's volume that movables fill; phi2: movables inside; phi3: for
/// each of those, mass times friction times the share of its volume inside.
struct RegionFeatures {
  double phi1 = 0;
  int phi2 = 0;
  std::vector<double> phi3;
};
/// `loads`: one per object of the scene; objects of share 0 do not count.
RegionFeatures region_features(const VoxelVolume& region, const std::vector<ObjectLoad>& loads);

/// Parameters of the naive Bayes model: a beta density of phi1, exponential densities of phi2 and of each phi3. The
/// defaults come from `mamo train` (bench/data/em4m_priority.yaml); bench/suites/em4m_priority.yaml has the published
/// ones.
struct PriorityParameters {
  double prior = 0.7529550827423168;       // P(E)
  double phi1_alpha = 0.6050121196764923;  // of the beta density
  double phi1_beta = 23.81728980460192;    // of the beta density
  double phi2_rate = 3.114583333333333;    // of the exponential density
  double phi3_rate = 17.023411885864185;   // of the exponential density
  /// The density of each phi3 relative to its largest value, so that one more object in the region never makes a
  /// rearrangement more promising; the density as it is exceeds 1 near 0 and does (EM4M_FACTS section 10).
  bool phi3_relative = true;
  void add_to(OptionTable& table);
};

/// Larger is more promising.
using Priority = std::array<double, 3>;
/// {log f(v), 0, 0}; infinite for a free region.
Priority learned_priority(const RegionFeatures& features, const PriorityParameters& parameters);
/// {-phi1, -phi2, -sum of phi3}, compared in this order.
Priority lexicographic_priority(const RegionFeatures& features);

}  // namespace mamo
