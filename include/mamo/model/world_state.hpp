// Where the objects are: quantised poses, so that equal states are equal bits wherever they came from.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "mamo/model/scene.hpp"

namespace mamo {

/// A pose rounded to 1e-6 m and 1e-6 per quaternion component (sign made canonical). The integers are the
/// state; dequantise() is a pure function of them.
struct QuantisedPose {
  std::array<std::int32_t, 3> p{0, 0, 0};           // micrometres
  std::array<std::int32_t, 4> q{0, 0, 0, 1000000};  // x, y, z, w times 1e6
  friend auto operator<=>(const QuantisedPose&, const QuantisedPose&) = default;
};

/// Positions beyond +-2 km are clamped. X must be finite.
QuantisedPose quantise(const Eigen::Isometry3d& X);
Eigen::Isometry3d dequantise(const QuantisedPose& pose);

/// One pose per object of the scene (fixtures included, constant). Copied freely; holds no velocity:
/// between motions objects are at rest.
struct WorldState {
  std::vector<QuantisedPose> poses;

  static WorldState start_of(const Scene& scene);
  const QuantisedPose& operator[](ObjectId id) const { return poses[id.index()]; }
  QuantisedPose& operator[](ObjectId id) { return poses[id.index()]; }
  Eigen::Isometry3d X_WO(ObjectId id) const { return dequantise(poses[id.index()]); }
  friend bool operator==(const WorldState&, const WorldState&) = default;
};

}  // namespace mamo
