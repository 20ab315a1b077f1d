#include "em4m/vertex.hpp"

#include <cmath>

#include "mamo/common/hash.hpp"

namespace mamo {
namespace {

/// Does turning the object about its own z axis change nothing?
bool symmetric(const Object& object) {
  if (object.shapes.size() != 1) return false;
  const PlacedShape& placed = object.shapes.front();
  const bool about_axis = placed.X_BS.translation().head<2>().norm() < 1e-9 &&
                          (placed.X_BS.linear().col(2) - Eigen::Vector3d::UnitZ()).norm() < 1e-9;
  return about_axis && (std::holds_alternative<Cylinder>(placed.shape) || std::holds_alternative<Sphere>(placed.shape));
}

}  // namespace

RearrangementClass class_of(const Scene& scene, const std::vector<ObjectId>& movables, const WorldState& state) {
  constexpr double kPositionBin = 0.01, kDirectionBin = 0.0872;  // m; sin of 5 degrees
  RearrangementClass key;
  for (ObjectId id : movables) {
    const Eigen::Isometry3d X_WO = state.X_WO(id);
    for (int a = 0; a < 3; ++a)
      key.push_back(static_cast<std::int32_t>(std::lround(X_WO.translation()[a] / kPositionBin)));
    for (int column : {2, 0}) {
      if (column == 0 && symmetric(scene[id])) continue;
      for (int a = 0; a < 3; ++a)
        key.push_back(static_cast<std::int32_t>(std::lround(X_WO.linear()(a, column) / kDirectionBin)));
    }
  }
  return key;
}

std::uint64_t content_hash(const std::vector<ObjectId>& movables, const WorldState& state) {
  HashStream hash;
  for (ObjectId id : movables) {
    for (std::int32_t v : state[id].p) hash.add(v);
    for (std::int32_t v : state[id].q) hash.add(v);
  }
  return hash.value();
}

}  // namespace mamo
