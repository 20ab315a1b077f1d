// Mass and inertia of shapes, and bodies made of several.
#include "physics/body_shape.hpp"

#include <gtest/gtest.h>

#include "physics/mass_properties.hpp"
#include "support/pusher.hpp"

#include "mamo/physics/world.hpp"

namespace mamo {
namespace {

using namespace pushing;

/// A box as a hull, its corners shifted by `offset` in the shape's frame.
Mesh box_hull(const Eigen::Vector3d& size, const Eigen::Vector3d& offset) {
  auto hull = std::make_shared<ConvexHull>();
  for (int k = 0; k < 8; ++k)
    hull->vertices.emplace_back(
        offset + Eigen::Vector3d(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5).cwiseProduct(size));
  hull->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  hull->volume = size.prod();
  hull->centroid = offset;
  return Mesh{hull};
}

const Eigen::Vector3d kSize(0.1, 0.06, 0.2);

TEST(MassProperties, AHullOfABoxIsTheBox) {
  const Eigen::Vector3d offset(0.3, -0.2, 0.1);
  const MassProperties box = mass_properties(Shape(Box{kSize})), hull = mass_properties(Shape(box_hull(kSize, offset)));
  EXPECT_NEAR(hull.volume, box.volume, 1e-12);
  EXPECT_LT((hull.centre - offset).norm(), 1e-12);
  EXPECT_LT((hull.inertia - box.inertia).norm(), 1e-12 * box.inertia.norm() + 1e-15);
}

TEST(MassProperties, PartsAddUpToTheWhole) {
  const Box half{{0.1, 0.06, 0.1}};
  const std::vector<PlacedShape> halves = {{half, at(0, 0, 0.05)}, {half, at(0, 0, -0.05, std::numbers::pi)}};
  const MassProperties whole = mass_properties(Shape(Box{kSize})), parts = mass_properties(halves);
  EXPECT_NEAR(parts.volume, whole.volume, 1e-15);
  EXPECT_LT(parts.centre.norm(), 1e-15);
  EXPECT_LT((parts.inertia - whole.inertia).norm(), 1e-15);
}

TEST(MassProperties, PrimitivesMatchTheirFormulas) {
  const MassProperties c = mass_properties(Shape(Cylinder{0.05, 0.2}));
  EXPECT_NEAR(c.inertia(2, 2) / c.volume, 0.05 * 0.05 / 2, 1e-12);
  EXPECT_NEAR(c.inertia(0, 0) / c.volume, (3 * 0.05 * 0.05 + 0.2 * 0.2) / 12, 1e-12);
  const MassProperties s = mass_properties(Shape(Sphere{0.05}));
  EXPECT_NEAR(s.inertia(1, 1) / s.volume, 0.4 * 0.05 * 0.05, 1e-12);
}

TEST(BodyShape, FrameCIsAtTheCentreOfMassAlongPrincipalAxes) {
  RandomStream random(5, {});
  for (int k = 0; k < 50; ++k) {
    Object o;
    for (int i = 0; i < 3; ++i) {
      Eigen::Isometry3d X = at(random.normal(), random.normal(), random.normal(), random.uniform(0, 6));
      X.rotate(Eigen::AngleAxisd(random.uniform(0, 3), Eigen::Vector3d::UnitX()));
      const double a = random.uniform(0.1, 1), b = random.uniform(0.1, 1);
      o.shapes.push_back({i == 0 ? Shape(Box{{a, b, 0.2}}) : i == 1 ? Shape(Cylinder{a, b}) : Shape(Sphere{a}), X});
    }
    const BodyShape body(o.shapes);
    EXPECT_LT((body.X_BC().translation() - o.centre_of_mass()).norm(), 1e-9);
    const MassProperties m = mass_properties(o.shapes);
    const Eigen::Matrix3d R = body.X_BC().linear();
    EXPECT_NEAR(R.determinant(), 1, 1e-9);
    const Eigen::Matrix3d diagonal = body.inertia(m.volume).asDiagonal();
    EXPECT_LT((R * diagonal * R.transpose() - m.inertia).norm(), 1e-9 * m.inertia.norm());
  }
}

/// Where an object ends when the finger pushes it by 10 cm.
Eigen::Isometry3d pushed(const std::vector<PlacedShape>& shapes, const Eigen::Isometry3d& X_WO) {
  Bench bench{table()};
  Object o = block("o", 0, 0, kSize, 0.4);
  o.shapes = shapes;
  o.X_WO = X_WO;
  const ObjectId id = add(bench.scene, o);
  const Evaluation e = bench.evaluate(along({{-0.12, 0.01, kTop + 0.03}, {0.03, 0.01, kTop + 0.03}}));
  EXPECT_TRUE(e.valid);
  return e.state.X_WO(id);
}

TEST(BodyShape, TheSameBoxIsPushedAlikeHoweverItIsPutTogether) {
  const Eigen::Isometry3d X = at(0, 0, kTop + 0.1);
  const Eigen::Isometry3d box = pushed({{Box{kSize}, at(0, 0, 0)}}, X);
  EXPECT_GT(box.translation().x(), 0.09);
  const Box half{{0.1, 0.06, 0.1}};
  const Eigen::Isometry3d off = at(0.2, -0.1, 0.3, 0.7);  // the object's frame far from its centre
  const std::vector<std::pair<const char*, Eigen::Isometry3d>> others = {
      {"halves", pushed({{half, at(0, 0, 0.05)}, {half, at(0, 0, -0.05)}}, X)},
      {"frame elsewhere", pushed({{Box{kSize}, off}}, X * off.inverse()) * off},
      {"hull", pushed({{box_hull(kSize, {0, 0, 0}), at(0, 0, 0)}}, X)},
      {"hull elsewhere", pushed({{box_hull(kSize, {0.3, 0, 0}), at(-0.3, 0, 0)}}, X)},
  };
  for (const auto& [name, X_end] : others) {
    EXPECT_LT((X_end.translation() - box.translation()).norm(), 0.006) << name;
    EXPECT_LT(Eigen::AngleAxisd(X_end.linear().transpose() * box.linear()).angle(), 0.08) << name;
  }
}

}  // namespace
}  // namespace mamo
