// Pairs of solids: contacts FCL 0.7 is known to stumble over, hulls, and the bounds in front of FCL.
#include "collision/solid.hpp"

#include "collision/hull_offset.hpp"
#include "support/brute_force.hpp"
#include "support/hulls.hpp"
#include "support/robots.hpp"

namespace mamo::collision {
namespace {

constexpr std::uint64_t kSeed = 51;

struct Body {
  Solid solid;
  Placed X;
};

Body body(const Shape& shape, const Eigen::Isometry3d& X, double padding = 0) {
  Eigen::Vector3d centre;
  Body out;
  out.solid = make_solid(shape, padding, centre);
  out.X = {X.linear(), X * centre};
  return out;
}

Relation relation(const Body& a, const Body& b, double clearance = 0) {
  const Relation forth = relate(a.solid, a.X, b.solid, b.X, clearance);
  const Relation back = relate(b.solid, b.X, a.solid, a.X, clearance);
  EXPECT_EQ(forth == Relation::hit, back == Relation::hit);
  return forth;
}
bool hit(const Shape& a, const Eigen::Isometry3d& X_WA, const Shape& b, const Eigen::Isometry3d& X_WB) {
  return relation(body(a, X_WA), body(b, X_WB)) == Relation::hit;
}

std::vector<Shape> shapes() {
  return {Box{{0.1, 0.06, 0.2}},
          Cylinder{0.04, 0.15},
          Sphere{0.05},
          Mesh{fixtures::ellipsoid_hull({0.05, 0.08, 0.1}, {0, 0, 0}, 8, 10)},
          Mesh{fixtures::box_hull({0.05, 0.03, 0.1}, {0, 0, 0})},
          Mesh{fixtures::ellipsoid_hull({0.03, 0.03, 0.12}, {0.2, 0.1, -0.05}, 9, 12)}};
}

/// A point that is certainly inside.
Eigen::Vector3d middle(const Shape& shape) {
  const Mesh* mesh = std::get_if<Mesh>(&shape);
  return mesh ? mesh->hull->centroid : Eigen::Vector3d::Zero();
}

TEST(Solid, CoincidentAndIdenticalBodiesHit) {
  for (const Shape& a : shapes())
    for (const Shape& b : shapes())
      for (double yaw : {0.0, 0.5, std::numbers::pi / 2}) {
        const Eigen::Isometry3d X = fixtures::at(0.3, -0.2, 0.7, yaw);
        EXPECT_TRUE(hit(a, X * Eigen::Translation3d(-middle(a)), b, X * Eigen::Translation3d(-middle(b))))
            << describe(a) << " in " << describe(b);
      }
}

TEST(Solid, ASmallBodyAnywhereInsideABigOneHits) {
  RandomStream random(kSeed, {1});
  const std::vector<Shape> big = {Box{{0.4, 0.4, 0.4}}, Cylinder{0.2, 0.4}, Sphere{0.2},
                                  Mesh{fixtures::ellipsoid_hull({0.2, 0.2, 0.2}, {0, 0, 0}, 10, 14)},
                                  Mesh{fixtures::box_hull({0.2, 0.2, 0.2}, {0, 0, 0})}};
  const std::vector<Shape> small = {Box{{0.01, 0.02, 0.01}}, Cylinder{0.005, 0.01}, Sphere{0.004},
                                    Mesh{fixtures::ellipsoid_hull({0.004, 0.01, 0.008}, {0, 0, 0}, 6, 7)}};
  for (const Shape& outer : big)
    for (const Shape& inner : small)
      for (int k = 0; k < 200; ++k) {
        const Eigen::Isometry3d X_WOuter = fixtures::random_pose(random, 1);
        ASSERT_TRUE(hit(outer, X_WOuter, inner, X_WOuter * fixtures::random_pose(random, 0.1)))
            << describe(inner) << " in " << describe(outer) << ", seed " << kSeed << ", k " << k;
      }
}

TEST(Solid, FacesThatAreAHairApartDoNotHitAndAHairDeepDo) {
  // Flush contacts along a face, the usual state of things on a shelf. z: how far the upper body is lifted.
  const std::vector<std::pair<Shape, double>> flat = {{Box{{0.1, 0.06, 0.2}}, 0.1},
                                                      {Cylinder{0.04, 0.15}, 0.075},
                                                      {Mesh{fixtures::box_hull({0.05, 0.03, 0.1}, {0, 0, 0})}, 0.1}};
  for (const auto& [a, half_a] : flat)
    for (const auto& [b, half_b] : flat)
      for (double yaw : {0.0, 0.7853981633974483, 1.1})
        for (double shift : {0.0, 0.01, 0.03}) {
          const auto lifted = [&](double gap) { return fixtures::at(shift, 0, half_a + half_b + gap, yaw); };
          EXPECT_FALSE(hit(a, fixtures::at(0, 0, 0), b, lifted(1e-5))) << describe(a) << " under " << describe(b);
          EXPECT_TRUE(hit(a, fixtures::at(0, 0, 0), b, lifted(-1e-5))) << describe(a) << " under " << describe(b);
          EXPECT_NO_THROW(hit(a, fixtures::at(0, 0, 0), b, lifted(0)));
        }
}

TEST(Solid, ApartIsNeverSaidOfBodiesCloserThanTheClearance) {
  // The distance is measured by moving one body: if they are further apart than c, no move of length c makes them hit.
  RandomStream random(kSeed, {2});
  const std::vector<Shape> all = shapes();
  int apart = 0, near = 0, hits = 0;
  for (int k = 0; k < 20000; ++k) {
    const Body a = body(all[random.below(all.size())], fixtures::random_pose(random, 0.15));
    Body b = body(all[random.below(all.size())], fixtures::random_pose(random, 0.15));
    const double clearance = random.uniform(0, 0.1);
    const Relation before = relation(a, b, clearance);
    ++(before == Relation::apart ? apart : before == Relation::near ? near : hits);
    if (before != Relation::apart) continue;
    Eigen::Vector3d towards =
        (a.X.p - b.X.p).normalized() + 0.5 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    b.X.p += towards.normalized() * clearance;
    ASSERT_NE(relation(a, b), Relation::hit) << "seed " << kSeed << ", k " << k;
  }
  EXPECT_GT(std::min({apart, near, hits}), 500);
}

TEST(Solid, AgreesWithFclOnAllKindsOfPairs) {
  RandomStream random(kSeed, {3});
  const std::vector<Shape> all = shapes();
  std::vector<fixtures::FclShape> fcl;
  for (const Shape& s : all) fcl.push_back(fixtures::fcl_shape(s, 0));
  const fcl::CollisionRequestd request(1, false);
  for (int k = 0; k < 30000; ++k) {
    const std::size_t i = random.below(all.size()), j = random.below(all.size());
    const Eigen::Isometry3d A = fixtures::random_pose(random, 0.1), B = fixtures::random_pose(random, 0.1);
    fcl::CollisionResultd result;
    const bool expected = fcl::collide(fcl[i].get(), A, fcl[j].get(), B, request, result) > 0;
    ASSERT_EQ(hit(all[i], A, all[j], B), expected)
        << describe(all[i]) << " and " << describe(all[j]) << ", seed " << kSeed << ", k " << k;
  }
}

/// Largest distance in direction d of a set of points.
double reach(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& d) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& p : points) largest = std::max(largest, p.dot(d));
  return largest;
}

TEST(HullOffset, AGrownHullHoldsEverythingWithinTheDistance) {
  RandomStream random(kSeed, {4});
  const double pad = 0.0055;
  for (const auto& hull : {fixtures::ellipsoid_hull({0.05, 0.08, 0.1}, {0.1, 0, 0}, 8, 10),
                           fixtures::ellipsoid_hull({0.1, 0.1, 0.004}, {0, 0, 0}, 6, 12),
                           fixtures::box_hull({0.05, 0.03, 0.1}, {0, 0.2, 0})}) {
    const std::vector<Eigen::Vector3d> grown = offset_vertices(*hull, pad);
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      const Eigen::Vector3d d = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const double more = reach(grown, d) - reach(hull->vertices, d);
      ASSERT_GE(more, pad - 1e-12) << "seed " << kSeed << ", k " << k;
      worst = std::max(worst, more);
    }
    EXPECT_LT(worst, 8 * pad);
  }
}

TEST(HullOffset, AShrunkHullLiesThatDeepUnderEveryFace) {
  const auto hull = fixtures::ellipsoid_hull({0.05, 0.08, 0.1}, {0.1, 0, 0}, 8, 10);
  for (const auto& v : offset_vertices(*hull, -0.001)) EXPECT_LE(signed_distance(Mesh{hull}, v), -0.001 + 1e-12);
}

}  // namespace
}  // namespace mamo::collision
