// Shelves with a target and a negative goal region: the way out of the target, as a box.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/fixtures.hpp"

#include "mamo/collision/voxel_volume.hpp"

namespace mamo::test {

struct ShelfCase {
  std::string name;
  Problem problem;
  ObjectId target;
  WorldState state;
  VoxelVolume region;
};

/// A box from behind the target to 30 cm in front of the shelf, as wide as the target or a hand, 10 cm high.
inline VoxelVolume way_out(const Scene& scene, ObjectId target, double yaw, double cell = 0.01) {
  VoxelVolume region(Eigen::AlignedBox3d(Eigen::Vector3d(0.2, -1.0, 0.77), Eigen::Vector3d(1.1, 0.0, 1.09)), cell);
  const Object& object = scene[target];
  const double width =
      std::max(0.12, bounds(object.shapes[0].shape, Eigen::Isometry3d::Identity()).sizes().head<2>().norm());
  const double length = 0.9;
  const Eigen::Isometry3d X_WT = fixtures::at(object.X_WO.translation().x(), object.X_WO.translation().y(), 0.85, yaw);
  region.add(Box{{length, width, 0.1}}, X_WT * fixtures::at(0.03 - length / 2, 0, 0));
  return region;
}

/// The immovable farthest back is the target; it comes out towards the robot's shoulder.
inline ShelfCase shelf_case(int movables, int immovables, std::uint64_t seed) {
  ShelfCase out;
  out.name = std::to_string(movables) + " movables, seed " + std::to_string(seed);
  out.problem.scene = fixtures::cluttered_shelf(movables, immovables, seed);
  const Scene& scene = out.problem.scene;
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scene.objects[i].kind == ObjectKind::immovable &&
        (!out.target.valid() || scene.objects[i].X_WO.translation().x() > scene[out.target].X_WO.translation().x()))
      out.target = ObjectId(i);
  const Eigen::Vector3d p = scene[out.target].X_WO.translation();
  out.state = WorldState::start_of(scene);
  out.region = way_out(scene, out.target, std::atan2(p.y() + 0.4, p.x() - 0.1));
  return out;
}

}  // namespace mamo::test
