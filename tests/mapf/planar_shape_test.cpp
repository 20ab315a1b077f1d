// Rounded polygons against dense samples of their points.
#include "mapf/planar_shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mamo/common/random.hpp"

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;

/// A point, a segment or up to six points in a square of 10 cm, rounded or not.
PlanarShape random_shape(RandomStream& random) {
  std::vector<Vector2d> points;
  for (std::uint64_t k = 0, n = 1 + random.below(6); k < n; ++k)
    points.emplace_back(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05));
  const bool rounded = points.size() < 3 || random.below(2) == 0;
  return {std::move(points), rounded ? random.uniform(0.005, 0.03) : 0.0};
}

/// Points of the boundary, less than 0.5 mm apart.
std::vector<Vector2d> boundary_of(const PlanarShape& shape) {
  std::vector<Vector2d> out;
  const auto& v = shape.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (int k = 0; k < 400; ++k) {
      const double angle = 2 * std::numbers::pi * k / 400;
      out.push_back(v[i] + shape.radius() * Vector2d(std::cos(angle), std::sin(angle)));
    }
    const Vector2d way = v[(i + 1) % v.size()] - v[i];
    if (way.norm() == 0) continue;
    const Vector2d normal = Vector2d(way.y(), -way.x()).normalized();
    for (int k = 0; k <= 400; ++k) out.push_back(v[i] + way * (k / 400.0) + shape.radius() * normal);
  }
  // Corners' circles lie partly inside.
  std::erase_if(out, [&](const Vector2d& p) { return shape.signed_distance(p) < -1e-7; });
  return out;
}

TEST(PlanarShape, TheDistanceIsThatToTheNearestPointOfTheBoundary) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {1});
    const PlanarShape shape = random_shape(random);
    const std::vector<Vector2d> boundary = boundary_of(shape);
    ASSERT_FALSE(boundary.empty());
    for (int k = 0; k < 50; ++k) {
      const Vector2d p(random.uniform(-0.12, 0.12), random.uniform(-0.12, 0.12));
      double nearest = 1;
      for (const Vector2d& q : boundary) nearest = std::min(nearest, (p - q).norm());
      EXPECT_NEAR(std::abs(shape.signed_distance(p)), nearest, 5e-4);
    }
  }
}

TEST(PlanarShape, TheInsideOfAPolygonIsWhereEveryEdgeHasItOnItsLeft) {
  const PlanarShape square({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0}, {1e-12, 0}}, 0);
  EXPECT_EQ(square.vertices().size(), 4u);
  EXPECT_DOUBLE_EQ(square.signed_distance({0.5, 0.4}), -0.4);
  EXPECT_DOUBLE_EQ(square.signed_distance({2, 0.4}), 1);
  EXPECT_DOUBLE_EQ(square.signed_distance({4, 5}), 5);
}

TEST(PlanarShape, TwoShapesMeetExactlyWhereTheirDifferenceSaysSo) {
  int meetings = 0, tried = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {2});
    const PlanarShape a = random_shape(random), b = random_shape(random);
    const PlanarShape difference = minkowski_difference(a, b);
    const Vector2d at(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15));
    const double distance = difference.signed_distance(at);
    if (std::abs(distance) < 1e-3) continue;  // too close for samples to tell
    ++tried;
    bool meet = false;  // one has a boundary point in the other, or contains it
    for (const Vector2d& p : boundary_of(a)) meet = meet || b.signed_distance(p - at) <= 0;
    for (const Vector2d& p : boundary_of(b)) meet = meet || a.signed_distance(p + at) <= 0;
    EXPECT_EQ(distance < 0, meet) << distance;
    meetings += meet;
  }
  EXPECT_GT(meetings, tried / 10);
  EXPECT_LT(meetings, tried * 9 / 10);
}

TEST(PlanarShape, ACommonPointIsInsideOfBothAndFoundWhereTheyOverlapWell) {
  int overlaps = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {3});
    const PlanarShape a = random_shape(random), b = random_shape(random);
    const Vector2d at(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    const double distance = minkowski_difference(a, b).signed_distance(at);
    Vector2d p;
    const bool found = common_point(a, {0, 0}, b, at, p);
    if (distance > 0 || distance < -0.003) {
      EXPECT_EQ(found, distance < 0);
    }
    if (!found) continue;
    ++overlaps;
    EXPECT_LT(a.signed_distance(p), 0);
    EXPECT_LT(b.signed_distance(p - at), 0);
  }
  EXPECT_GT(overlaps, 50);
}

}  // namespace
}  // namespace mamo::mapf
