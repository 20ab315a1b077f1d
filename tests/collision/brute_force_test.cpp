// The checker against all pairs of fcl::collide, on configurations and on the samples of edges.
#include "support/brute_force.hpp"

#include "support/hulls.hpp"
#include "support/robots.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 31;

ObjectSet everything(const Scene& scene) {
  ObjectSet set(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) set.insert(ObjectId(i));
  return set;
}

/// Boxes, cylinders, spheres, hulls and bodies of two shapes floating around the made-up robot.
Scene floating_scene(bool hulls, std::uint64_t seed) {
  Scene scene;
  RandomStream random(seed, {5});
  for (int k = 0; k < 20; ++k) {
    Object o;
    o.id = "o" + std::to_string(k);
    const double a = random.uniform(0.02, 0.1), b = random.uniform(0.02, 0.1), c = random.uniform(0.02, 0.2);
    const auto shape = [&](int kind) -> Shape {
      if (kind == 0) return Box{{a, b, c}};
      if (kind == 1) return Cylinder{a, c};
      if (kind == 2) return Sphere{b};
      return Mesh{fixtures::ellipsoid_hull({a, b, c}, {0.03, -0.02, 0.01}, 7, 9)};
    };
    const int kinds = hulls ? 4 : 3;
    o.shapes.push_back({shape(k % kinds), Eigen::Isometry3d::Identity()});
    if (k % 5 == 0) o.shapes.push_back({shape((k + 1) % kinds), fixtures::random_pose(random, 0.1)});
    o.X_WO = fixtures::random_pose(random, 0.8);
    scene.objects.push_back(o);
  }
  return scene;
}

Robot made_up_robot_with_pairs() {
  Robot robot = fixtures::made_up_robot();
  choose_self_pairs(robot, {}, false, 1);
  return robot;
}

struct World {
  const char* name;
  Robot robot;
  Scene scene;
};

std::vector<World> worlds(bool hulls) {
  return {{"shelf", fixtures::pr2_like_arm(), fixtures::cluttered_shelf(10, 5, 3)},
          {"floating", made_up_robot_with_pairs(), floating_scene(hulls, 1)},
          {"floating around an arm", fixtures::pr2_like_arm(), floating_scene(hulls, 2)}};
}

TEST(CollisionChecker, AgreesWithAllPairsOnConfigurations) {
  for (const World& w : worlds(true)) {
    CollisionChecker checker(std::make_shared<ForwardKinematics>(w.robot), w.scene);
    fixtures::BruteForce reference(w.robot, w.scene, 0);
    RandomStream random(kSeed, {1});
    CollisionReport report;
    int hits = 0, selves = 0;
    for (int k = 0; k < 2000; ++k) {
      const Eigen::VectorXd q = fixtures::random_configuration(w.robot, random);
      checker.check(q, everything(w.scene), false, report);
      ASSERT_EQ(report.touched, reference.touched(q)) << w.name << ", seed " << kSeed << ", k " << k;
      ASSERT_EQ(report.self, reference.self(q)) << w.name << ", seed " << kSeed << ", k " << k;
      hits += !report.touched.empty();
      selves += report.self;
      CollisionReport quick;
      checker.check(q, everything(w.scene), true, quick);
      ASSERT_EQ(quick.free(), report.free());
    }
    EXPECT_GT(hits, 100) << w.name;
    EXPECT_GT(selves, 20) << w.name;
  }
}

TEST(CollisionChecker, AgreesWithAllPairsAtTheSamplesOfEdges) {
  for (const World& w : worlds(false)) {
    const CollisionOptions options{0.01, 0.0055};  // coarse: brute force pays for every sample
    CollisionChecker checker(std::make_shared<ForwardKinematics>(w.robot), w.scene, options);
    fixtures::BruteForce plain(w.robot, w.scene, 0), padded(w.robot, w.scene, options.padding);
    RandomStream random(kSeed, {2});
    CollisionReport report;
    int blocked = 0, touching = 0, free = 0, selves = 0;
    for (int k = 0; k < 400; ++k) {
      const Eigen::VectorXd q0 = fixtures::random_configuration(w.robot, random);
      const double length = k % 10 == 0 ? 1.0 : 0.1;
      const Eigen::VectorXd q1 = q0 + length * (fixtures::random_configuration(w.robot, random) - q0);
      ObjectSet forbidden(w.scene.size()), watched(w.scene.size());
      for (std::size_t i = 0; i < w.scene.size(); ++i) {
        const std::uint64_t draw = random.below(8);
        if (draw == 0) forbidden.insert(ObjectId(i));
        if (draw > 1) watched.insert(ObjectId(i));
      }
      std::vector<std::uint8_t> seen(w.scene.size(), 0);
      bool self = false, forbidden_hit = false;
      double first_touch = 2;
      for (double s : checker.edge_samples(q0, q1)) {
        const Eigen::VectorXd q = (1.0 - s) * q0 + s * q1;
        self = self || plain.self(q);
        for (ObjectId id : plain.touched(q)) forbidden_hit = forbidden_hit || forbidden.contains(id);
        for (ObjectId id : padded.touched(q)) {
          seen[id.index()] = 1;
          if (watched.contains(id) && !forbidden.contains(id)) first_touch = std::min(first_touch, s);
        }
      }
      const bool passes = checker.check_edge(q0, q1, forbidden, watched, report);
      ASSERT_EQ(passes, !self && !forbidden_hit) << w.name << ", seed " << kSeed << ", edge " << k;
      if (!passes) {
        if (report.self) {
          ASSERT_TRUE(self && report.touched.empty());
        } else {
          ASSERT_EQ(report.touched.size(), 1u);
          ASSERT_TRUE(forbidden.contains(report.touched[0]) && seen[report.touched[0].index()]);
        }
        ++(report.self ? selves : blocked);
        continue;
      }
      std::vector<ObjectId> expected;
      for (std::size_t i = 0; i < w.scene.size(); ++i)
        if (seen[i] && watched.contains(ObjectId(i))) expected.emplace_back(i);
      ASSERT_EQ(report.touched, expected) << w.name << ", seed " << kSeed << ", edge " << k;
      ASSERT_EQ(report.first_touch, first_touch) << w.name << ", seed " << kSeed << ", edge " << k;
      ++(expected.empty() ? free : touching);
    }
    std::printf("%s: free %d touching %d blocked %d self %d\n", w.name, free, touching, blocked, selves);
    EXPECT_GT(std::min({free, touching, blocked, selves}), 5) << w.name;
  }
}

}  // namespace
}  // namespace mamo
