// What footprints and the region's shadow say, against the shapes and voxels themselves.
#include "mapf/footprint.hpp"

#include <gtest/gtest.h>

#include "mapf/region_shadow.hpp"
#include "support/fixtures.hpp"
#include "support/hulls.hpp"
#include "support/replay_paths.hpp"

#include "mamo/common/random.hpp"

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A body of one or two shapes; upright, lying or at any angle.
Object random_object(RandomStream& random, bool upright) {
  Object o;
  for (std::uint64_t k = 0, n = 1 + random.below(2); k < n; ++k) {
    PlacedShape s;
    switch (random.below(4)) {
      case 0:
        s.shape = Box{{random.uniform(0.04, 0.1), random.uniform(0.04, 0.1), random.uniform(0.08, 0.2)}};
        break;
      case 1:
        s.shape = Cylinder{random.uniform(0.02, 0.05), random.uniform(0.08, 0.2)};
        break;
      case 2:
        s.shape = Sphere{random.uniform(0.02, 0.05)};
        break;
      default:
        s.shape = Mesh{fixtures::ellipsoid_hull({0.05, 0.03, 0.08}, {0, 0, 0}, 5, 8)};
        break;
    }
    s.X_BS.translation() = Vector3d(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0);
    o.shapes.push_back(s);
  }
  const double tilt = upright ? 0 : random.uniform(0, 3.1);
  o.X_WO = fixtures::at(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.1, random.uniform(0, 6));
  o.X_WO.rotate(Eigen::AngleAxisd(tilt, Vector3d(random.normal(), random.normal(), 0.1).normalized()));
  return o;
}

TEST(Footprint, ContainsEveryPointOfTheBody) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {1});
    const Object o = random_object(random, seed % 2 == 0);
    const Footprint footprint = footprint_of(o, o.X_WO);
    double low = 1;
    for (const Vector3d& p : test::cloud_of(o, 0.004)) {
      const Vector3d q = o.X_WO * p;
      bool inside = false;
      for (const Prism& prism : footprint.prisms)
        inside = inside || (q.z() > prism.low - 1e-9 && q.z() < prism.high + 1e-9 &&
                            prism.shadow.signed_distance((q - o.X_WO.translation()).head<2>()) < 1e-9);
      EXPECT_TRUE(inside);
      EXPECT_LE((q - o.X_WO.translation()).head<2>().norm(), footprint.reach + 1e-9);
      low = std::min(low, q.z());
    }
    EXPECT_NEAR(footprint.low, low, 0.006);
  }
}

TEST(Footprint, OfAnUprightBoxOrCylinderIsExactAndOfALyingCylinderNearly) {
  Object box;
  box.shapes = {{Box{{0.1, 0.06, 0.2}}, Eigen::Isometry3d::Identity()}};
  const PlanarShape shadow = footprint_of(box, fixtures::at(1, 2, 0.5, 0.3)).prisms[0].shadow;
  const Vector2d along(std::cos(0.3), std::sin(0.3));
  EXPECT_NEAR(shadow.signed_distance(along * 0.07), 0.02, 1e-12);
  EXPECT_NEAR(shadow.signed_distance(along * 0.04), -0.01, 1e-12);
  Object cylinder;
  cylinder.shapes = {{Cylinder{0.03, 0.2}, Eigen::Isometry3d::Identity()}};
  EXPECT_NEAR(footprint_of(cylinder, fixtures::at(1, 2, 0.5, 1)).prisms[0].shadow.signed_distance({0.03, 0.04}), 0.02,
              1e-12);
  const Prism lying = footprint_of(cylinder, fixtures::lying(0, 0, 0.03)).prisms[0];
  EXPECT_NEAR(lying.shadow.upper().x(), 0.1, 1e-6);
  EXPECT_NEAR(lying.shadow.upper().y(), 0.03, 1e-3);
  EXPECT_NEAR(lying.high, 0.06, 1e-6);
}

TEST(Footprint, BodiesThatOverlapAreInEachOthersObstacleShapes) {
  int overlaps = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {2});
    const Object a = random_object(random, seed % 2 == 0), b = random_object(random, seed % 2 == 0);
    const double depth = test::overlap_depth(a, a.X_WO, test::cloud_of(a, 0.01), b, b.X_WO, test::cloud_of(b, 0.01));
    const double distance = signed_distance(obstacle_shapes(footprint_of(a, a.X_WO), footprint_of(b, b.X_WO)),
                                            (b.X_WO.translation() - a.X_WO.translation()).head<2>());
    if (depth > kLeastCommonHeight) {
      EXPECT_LT(distance, 0);
      ++overlaps;
    }
    apart += distance > 0;
  }
  EXPECT_GT(overlaps, 50);
  EXPECT_GT(apart, 50);
}

TEST(RegionShadow, AnObjectOverlapsTheRegionWhereItSharesSpaceWithAVoxel) {
  for (const double cell : {0.01, 0.015, 0.02})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " cell " + std::to_string(cell));
      RandomStream random(seed, {3});
      VoxelVolume region(Eigen::AlignedBox3d(Vector3d(-0.2, -0.2, 0), Vector3d(0.2, 0.2, 0.3)), cell);
      region.add(Box{{0.15, 0.03, 0.08}}, fixtures::at(0.05, 0.02, 0.12, random.uniform(0, 3)));
      const Object o = random_object(random, seed % 2 == 0);
      const Footprint footprint = footprint_of(o, o.X_WO);
      const CellGrid grid({-0.2, -0.15}, {0.2, 0.15}, 0.01);
      RegionShadow shadow(region);
      const std::vector<std::uint8_t> cells = shadow.overlapping_cells(footprint, grid);
      int inside = 0;
      for (std::int32_t n = 0; n < grid.size(); ++n) {
        const Vector2d p = grid.centre(grid.at(n));
        EXPECT_EQ(cells[static_cast<std::size_t>(n)] != 0, shadow.overlaps(footprint, p));
        Eigen::Isometry3d X = o.X_WO;
        X.translation().head<2>() = p;
        if (region.overlap(o, X).common_cells > 0) {
          EXPECT_TRUE(cells[static_cast<std::size_t>(n)]);
          ++inside;
        }
      }
      EXPECT_GT(inside, 10);
      EXPECT_LT(std::count(cells.begin(), cells.end(), 1), grid.size() * 9 / 10);
      EXPECT_GT(std::count(cells.begin(), cells.end(), 1), 20);
    }
}

}  // namespace
}  // namespace mamo::mapf
