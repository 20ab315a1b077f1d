#include "support/hulls.hpp"
#include "support/robots.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

using Pairs = std::vector<std::pair<ObjectId, ObjectId>>;

Pairs overlapping(const Scene& scene, double tolerance) {
  CollisionChecker checker(std::make_shared<ForwardKinematics>(fixtures::pr2_like_arm()), scene);
  return checker.overlapping_objects(tolerance);
}

/// Two bodies side by side along x, overlapping by `depth`.
Scene pair_of(const Shape& a, const Shape& b, double half_a, double half_b, double depth) {
  Scene scene = fixtures::shelf();
  for (int k = 0; k < 2; ++k) {
    Object o = fixtures::standing_cylinder(k ? "b" : "a", 0, 0, 0.01, 0.01);
    o.shapes = {{k ? b : a, Eigen::Isometry3d::Identity()}};
    o.X_WO = fixtures::at(k ? 0.75 + half_a + half_b - depth : 0.75, -0.5, 0.95);
    scene.objects.push_back(o);
  }
  return scene;
}

TEST(OverlappingObjects, AreThoseDeeperThanTheTolerance) {
  const Shape box = Box{{0.1, 0.08, 0.12}}, cylinder = Cylinder{0.04, 0.15}, sphere = Sphere{0.03};
  const Shape hull = Mesh{fixtures::box_hull({0.05, 0.05, 0.05}, {0, 0, 0})};
  const std::vector<std::pair<Shape, double>> shapes = {{box, 0.05}, {cylinder, 0.04}, {sphere, 0.03}, {hull, 0.05}};
  for (const auto& [a, half_a] : shapes)
    for (const auto& [b, half_b] : shapes) {
      const Pairs both = {{ObjectId{5}, ObjectId{6}}};
      EXPECT_EQ(overlapping(pair_of(a, b, half_a, half_b, 0.0012), 0.001), both) << describe(a) << ", " << describe(b);
      EXPECT_EQ(overlapping(pair_of(a, b, half_a, half_b, 0.0008), 0.001), Pairs{})
          << describe(a) << ", " << describe(b);
      EXPECT_EQ(overlapping(pair_of(a, b, half_a, half_b, 0.0), 0.001), Pairs{}) << describe(a) << ", " << describe(b);
    }
}

TEST(OverlappingObjects, StandingOnTheShelfOverlapsNothing) {
  for (std::uint64_t seed = 1; seed < 6; ++seed)
    EXPECT_TRUE(overlapping(fixtures::cluttered_shelf(10, 5, seed), 0.001).empty());
}

TEST(OverlappingObjects, FixturesMayOverlapFixtures) {
  Scene scene = fixtures::shelf();
  scene.objects[1].X_WO.translation().x() -= 0.1;  // the back into walls, base and top
  EXPECT_TRUE(overlapping(scene, 0.001).empty());
}

TEST(OverlappingObjects, AreLookedForAtTheStateThatWasSet) {
  const Scene scene = fixtures::cluttered_shelf(4, 0, 2);
  CollisionChecker checker(std::make_shared<ForwardKinematics>(fixtures::pr2_like_arm()), scene);
  WorldState state = WorldState::start_of(scene);
  state.poses[6] = state.poses[8];
  checker.set_state(state);
  EXPECT_EQ(checker.overlapping_objects(0.001), (Pairs{{ObjectId{6}, ObjectId{8}}}));
}

}  // namespace
}  // namespace mamo
