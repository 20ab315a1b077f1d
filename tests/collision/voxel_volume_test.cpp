#include "mamo/collision/voxel_volume.hpp"

#include <gtest/gtest.h>

namespace mamo {
namespace {

Object block(const Eigen::Vector3d& size) {
  Object object;
  object.shapes.push_back({Box{size}, Eigen::Isometry3d::Identity()});
  return object;
}
Eigen::Isometry3d at(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }

VoxelVolume metre_cube() { return VoxelVolume({Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}, 0.01); }

TEST(VoxelVolume, ABoxFillsItsVolumeAndHalfACellAround) {
  VoxelVolume volume = metre_cube();
  volume.add(Box{{0.2, 0.1, 0.3}}, at(0.5, 0.5, 0.5));
  EXPECT_TRUE(volume.contains(Eigen::Vector3d(0.405, 0.455, 0.355)));
  EXPECT_FALSE(volume.contains(Eigen::Vector3d(0.385, 0.5, 0.5)));
  EXPECT_GE(volume.count(), 20 * 10 * 30);
  EXPECT_LE(volume.count(), 22 * 12 * 32);
}

TEST(VoxelVolume, CellsOutsideTheBoundsAreNotKept) {
  VoxelVolume volume = metre_cube();
  volume.add(Sphere{0.2}, at(0, 0.5, 0.5));
  EXPECT_FALSE(volume.contains(Eigen::Vector3d(-0.05, 0.5, 0.5)));
  EXPECT_TRUE(volume.contains(Eigen::Vector3d(0.05, 0.5, 0.5)));
}

TEST(VoxelVolume, TheCommonPartOfAnObjectIsCounted) {
  VoxelVolume volume = metre_cube();
  volume.add(Box{{0.2, 0.2, 0.2}}, at(0.5, 0.5, 0.5));
  const VoxelVolume::Overlap half = volume.overlap(block({0.2, 0.1, 0.1}), at(0.6, 0.5, 0.5));
  EXPECT_EQ(half.object_cells, 20 * 10 * 10);
  EXPECT_NEAR(static_cast<double>(half.common_cells), 1000.0, 100.0);
  EXPECT_EQ(volume.overlap(block({0.1, 0.1, 0.1}), at(0.8, 0.5, 0.5)).common_cells, 0);
  EXPECT_EQ(volume.overlap(block({0.1, 0.1, 0.1}), at(3, 3, 3)).object_cells, 1000);
}

TEST(VoxelVolume, OverlappingShapesOfOneObjectCountOnce) {
  Object object = block({0.1, 0.1, 0.1});
  object.shapes.push_back({Box{{0.1, 0.1, 0.1}}, at(0.05, 0, 0)});
  EXPECT_EQ(metre_cube().overlap(object, at(0.5, 0.5, 0.5)).object_cells, 15 * 10 * 10);
}

}  // namespace
}  // namespace mamo
