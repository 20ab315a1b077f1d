// The object path finding on shelves: replayed step by step, against a brute-force oracle, and its rules one by one.
#include "mamo/mapf/object_paths.hpp"

#include <gmock/gmock.h>

#include <deque>
#include <thread>

#include "support/replay_paths.hpp"
#include "support/shelf_cases.hpp"

namespace mamo {
namespace {

using fixtures::at;
using fixtures::standing_cylinder;
using test::ShelfCase;
using testing::ElementsAre;
using testing::IsEmpty;

ObjectPathsResult solve(const ShelfCase& c, const ObjectPathsOptions& options = {},
                        const std::map<ObjectId, InvalidGoals>& invalid = {}) {
  return ObjectPathFinder(c.problem, c.target, options).solve(c.state, c.region, invalid, nullptr);
}

/// An empty shelf with a target at the back and a region that is a box on its floor.
ShelfCase empty_shelf(const Eigen::Vector3d& region_centre, const Eigen::Vector3d& region_size) {
  ShelfCase c;
  c.problem.scene = fixtures::shelf();
  c.target = ObjectId(c.problem.scene.size());
  c.problem.scene.objects.push_back(standing_cylinder("target", 1.0, -0.5, 0.03, 0.15, ObjectKind::immovable));
  c.region = VoxelVolume(Eigen::AlignedBox3d(Eigen::Vector3d(0.2, -1.0, 0.77), Eigen::Vector3d(1.1, 0.0, 1.09)), 0.01);
  c.region.add(Box{region_size}, at(region_centre.x(), region_centre.y(), region_centre.z()));
  return c;
}
ObjectId add(ShelfCase& c, const Object& object) {
  c.problem.scene.objects.push_back(object);
  c.state = WorldState::start_of(c.problem.scene);
  return ObjectId(c.problem.scene.size() - 1);
}

/// Segments of the shortcut, 1 mm apart, are no deeper in what stays than the start was.
std::string shortcut_error(const ShelfCase& c, const ObjectPath& path) {
  const Object& object = c.problem.scene[path.object];
  Eigen::Isometry3d X = c.state.X_WO(path.object);
  if ((path.points[0] - X.translation().head<2>()).norm() > 1e-12) return "does not start at the object";
  const Eigen::Vector2d goal(path.goal.x * 0.01, path.goal.y * 0.01);
  if (path.goal != path.cells[0] && (path.points.back() - goal).norm() > 1e-9) return "does not end at the goal";
  const auto cloud = test::cloud_of(object, 0.01);
  for (std::size_t i = 0; i < c.problem.scene.size(); ++i) {
    const Object& still = c.problem.scene.objects[i];
    if ((still.movable() && ObjectId(i) != c.target) || still.constraints.touch == Touch::support) continue;
    const auto still_cloud = test::cloud_of(still, 0.02);
    const auto depth = [&](const Eigen::Vector2d& p) {
      X.translation().head<2>() = p;
      return test::overlap_depth(object, X, cloud, still, still.X_WO, still_cloud);
    };
    const double at_start = depth(path.points[0]);
    for (std::size_t k = 0; k + 1 < path.points.size(); ++k)
      for (double t = 0; t <= 1; t += 0.02)
        if (depth(path.points[k] + t * (path.points[k + 1] - path.points[k])) > at_start + 0.001)
          return "cuts into " + still.id;
  }
  return "";
}

class OnShelves : public testing::TestWithParam<int> {};

TEST_P(OnShelves, EverySolutionHoldsWhenItIsReplayedAndNoInvalidGoalIsUsed) {
  int calls = 0, moved = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ShelfCase c = test::shelf_case(GetParam(), 4, seed);
    const ObjectPathFinder finder(c.problem, c.target, {});
    std::map<ObjectId, InvalidGoals> invalid;
    for (int round = 0; round < 4; ++round, ++calls) {
      const ObjectPathsResult result = finder.solve(c.state, c.region, invalid, nullptr);
      ASSERT_TRUE(result.solved);
      EXPECT_EQ(test::replay_error(c.problem, c.target, c.state, c.region, result, 0.0005, 0.01), "");
      EXPECT_TRUE(std::is_sorted(result.paths.begin(), result.paths.end(),
                                 [](const ObjectPath& a, const ObjectPath& b) { return a.object < b.object; }));
      for (const ObjectPath& path : result.paths) {
        EXPECT_EQ(shortcut_error(c, path), "");
        EXPECT_FALSE(invalid[path.object].contains(path.goal));
        invalid[path.object][path.goal] = 5;
        ++moved;
      }
    }
  }
  EXPECT_GT(moved, calls / 2);
}

TEST_P(OnShelves, TiltedLyingAndTouchingObjectsGetPathsThatHold) {
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ShelfCase c = test::shelf_case(GetParam(), 4, seed);
    RandomStream random(seed, {0x74696c74});
    for (std::size_t i = 0; i < c.problem.scene.size(); ++i) {
      const Object& o = c.problem.scene.objects[i];
      if (!o.movable()) continue;
      Eigen::Isometry3d X = c.state.X_WO(ObjectId(i));
      const Eigen::Vector3d axis(random.normal(), random.normal(), 0);
      const double tilt = random.below(3) == 0 ? std::numbers::pi / 2 : random.uniform(0, 0.2);
      X.rotate(Eigen::AngleAxisd(tilt, axis.normalized()));
      X.translation().z() += 0.77 - bounds(o.shapes[0].shape, X).min().z();
      c.state[ObjectId(i)] = quantise(X);
    }
    const ObjectPathsResult result = solve(c);
    if (!result.solved) continue;  // what lies across a wall may have nowhere to go
    ++solved;
    EXPECT_EQ(test::replay_error(c.problem, c.target, c.state, c.region, result, 0.006, 0.01), "");
  }
  EXPECT_GE(solved, 9);
}

INSTANTIATE_TEST_SUITE_P(Movables, OnShelves, testing::Values(5, 10, 15));

/// Steps of a standing cylinder to where it is clear of the region, by breadth-first search with distances of the
/// model's shapes; -1: none.
int brute_force_steps(const ShelfCase& c, ObjectId id) {
  const Object& object = c.problem.scene[id];
  const double radius = std::get<Cylinder>(object.shapes[0].shape).radius;
  const Eigen::Vector3d start = c.state.X_WO(id).translation();
  const auto free = [&](const Eigen::Vector3d& p) {
    if (!(p.x() > 0.48 && p.x() < 1.08 && p.y() > -0.9 && p.y() < -0.1)) return false;
    for (std::size_t i = 0; i < c.problem.scene.size(); ++i) {
      const Object& o = c.problem.scene.objects[i];
      if (o.movable() || o.id == "base" || o.id == "top") continue;
      const Eigen::Vector3d q = o.X_WO.inverse() * Eigen::Vector3d(p.x(), p.y(), o.X_WO.translation().z());
      if (signed_distance(o.shapes[0].shape, q) < radius - 1e-9) return false;
    }
    return true;
  };
  const auto clear = [&](const Eigen::Vector3d& p) {
    const VoxelVolume& r = c.region;
    for (int i = 0; i < r.size().x(); ++i)
      for (int j = 0; j < r.size().y(); ++j) {
        const Eigen::Vector2d d =
            ((p - r.centre_of({i, j, 0})).head<2>().cwiseAbs().array() - r.cell() / 2).cwiseMax(0.0);
        if (d.norm() > radius - 1e-9) continue;
        for (int k = 0; k < r.size().z(); ++k) {
          const double low = r.origin().z() + k * r.cell();
          if (low < 0.77 + 2 * (p.z() - 0.77) - 1e-6 && r.contains(Eigen::Vector3i(i, j, k))) return false;
        }
      }
    return true;
  };
  const GridCell first{static_cast<std::int32_t>(std::lround(start.x() * 100)),
                       static_cast<std::int32_t>(std::lround(start.y() * 100))};
  std::map<GridCell, int> steps{{first, 0}};
  std::deque<GridCell> open{first};
  while (!open.empty()) {
    const GridCell cell = open.front();
    open.pop_front();
    const auto place = [&](const GridCell& g) {
      return g == first ? start : Eigen::Vector3d(g.x * 0.01, g.y * 0.01, start.z());
    };
    if (clear(place(cell))) return steps[cell];
    for (const GridCell& next : {GridCell{cell.x + 1, cell.y}, GridCell{cell.x - 1, cell.y},
                                 GridCell{cell.x, cell.y + 1}, GridCell{cell.x, cell.y - 1}})
      if (!steps.contains(next) && free(place(next))) steps[next] = steps[cell] + 1, open.push_back(next);
  }
  return -1;
}

TEST(ObjectPaths, ACylinderAloneTakesTheFewestSteps) {
  int moved = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ShelfCase c = test::shelf_case(1, 12, seed);
    const ObjectId id = c.problem.scene.find("object_0");
    ObjectPathsOptions options;
    options.suboptimality = 1;
    const ObjectPathsResult result = solve(c, options);
    const int steps = brute_force_steps(c, id);
    ASSERT_EQ(result.solved, steps >= 0);
    if (steps < 0) {
      EXPECT_THAT(result.stuck, ElementsAre(id));
      continue;
    }
    EXPECT_EQ(result.cost, steps);
    if (steps == 0) continue;
    EXPECT_EQ(result.paths.at(0).cells.size(), static_cast<std::size_t>(steps) + 1);
    ++moved;
  }
  EXPECT_GT(moved, 5);
}

TEST(ObjectPaths, WhenTheRegionIsFreeNobodyMovesAndNothingIsSearched) {
  ShelfCase c = test::shelf_case(15, 4, 3);
  c.region = VoxelVolume(Eigen::AlignedBox3d(Eigen::Vector3d(0, -1, 0.77), Eigen::Vector3d(1, 0, 1)), 0.01);
  const ObjectPathsResult result = solve(c);
  EXPECT_TRUE(result.solved);
  EXPECT_THAT(result.paths, IsEmpty());
  EXPECT_EQ(result.low_level_expansions, 0);
  EXPECT_EQ(result.cost, 0);
}

//   seen from above, opening to the left; # immovable, region R around a:
//     ##########
//      b  R a R #        a can leave only past b, which stands clear of the region
//     ##########
TEST(ObjectPaths, AnObjectOutsideTheRegionMakesWayWhenItIsDisturbed) {
  ShelfCase c = empty_shelf({0.87, -0.5, 0.85}, {0.24, 0.1, 0.1});
  const ObjectId a = add(c, standing_cylinder("a", 0.82, -0.5, 0.03, 0.15));
  const ObjectId b = add(c, standing_cylinder("b", 0.68, -0.5, 0.03, 0.15));
  for (const double side : {-1.0, 1.0}) {
    Object wall = standing_cylinder(side < 0 ? "right" : "left", 0, 0, 0.01, 0.15, ObjectKind::immovable);
    wall.shapes[0].shape = Box{{0.5, 0.02, 0.15}};
    wall.X_WO = at(0.75, -0.5 + side * 0.05, 0.845);
    add(c, wall);
  }
  const ObjectPathsResult result = solve(c);
  ASSERT_TRUE(result.solved);
  ASSERT_EQ(result.paths.size(), 2u);
  EXPECT_EQ(result.paths[0].object, a);
  EXPECT_EQ(result.paths[1].object, b);
  EXPECT_LT(result.paths[1].goal.x, 68);
  EXPECT_EQ(test::replay_error(c.problem, c.target, c.state, c.region, result, 0.0005, 0.005), "");
}

TEST(ObjectPaths, AnObjectThatIsLockedInIsNamed) {
  ShelfCase c = empty_shelf({0.7, -0.5, 0.85}, {0.3, 0.3, 0.1});
  add(c, standing_cylinder("free", 0.56, -0.62, 0.03, 0.15));
  const ObjectId a = add(c, standing_cylinder("locked", 0.7, -0.5, 0.03, 0.15));
  for (int k = 0; k < 8; ++k)
    add(c, standing_cylinder("post_" + std::to_string(k), 0.7 + 0.08 * std::cos(k * 0.7854),
                             -0.5 + 0.08 * std::sin(k * 0.7854), 0.02, 0.15, ObjectKind::immovable));
  const ObjectPathsResult result = solve(c);
  EXPECT_FALSE(result.solved);
  EXPECT_FALSE(result.budget_used_up);
  EXPECT_THAT(result.stuck, ElementsAre(a));
}

TEST(ObjectPaths, WhatTouchesSomethingAtTheStartIsNotStuckByIt) {
  for (const double gap : {-0.002, 0.0, 0.0004}) {
    ShelfCase c = empty_shelf({0.7, -0.5, 0.85}, {0.1, 0.1, 0.1});
    add(c, standing_cylinder("a", 0.7043, -0.4968, 0.03, 0.15));
    // In a wedge of two posts, and leaning on a movable neighbour.
    add(c, standing_cylinder("post_1", 0.7043 + (0.05 + gap) * 0.6, -0.4968 + (0.05 + gap) * 0.8, 0.02, 0.15,
                             ObjectKind::immovable));
    add(c, standing_cylinder("post_2", 0.7043 + (0.05 + gap) * 0.8, -0.4968 - (0.05 + gap) * 0.6, 0.02, 0.15,
                             ObjectKind::immovable));
    add(c, standing_cylinder("b", 0.7043 - (0.06 + gap), -0.4968, 0.03, 0.15));
    const ObjectPathsResult result = solve(c);
    ASSERT_TRUE(result.solved) << gap;
    EXPECT_EQ(test::replay_error(c.problem, c.target, c.state, c.region, result, 0.0055, 0.005), "");
  }
}

TEST(ObjectPaths, TheNeighbourhoodOfAnInvalidGoalIsPenalisedUnlessThatIsOff) {
  ShelfCase c = empty_shelf({0.7, -0.5, 0.85}, {0.4, 0.1, 0.1});
  const ObjectId a = add(c, standing_cylinder("a", 0.7, -0.48, 0.03, 0.15));
  ObjectPathsOptions options;
  options.suboptimality = 1;
  const ObjectPathsResult first = solve(c, options);
  ASSERT_EQ(first.paths.size(), 1u);
  const GridCell goal = first.paths[0].goal;
  const std::map<ObjectId, InvalidGoals> invalid{{a, {{goal, 10}}}};
  const auto distance = [&](const ObjectPathsResult& r) {
    return std::max(std::abs(r.paths.at(0).goal.x - goal.x), std::abs(r.paths.at(0).goal.y - goal.y));
  };
  EXPECT_EQ(distance(solve(c, options, invalid)), 3);
  EXPECT_EQ(solve(c, options, invalid).cost, first.cost + 3);
  options.neighbour_penalties = false;
  EXPECT_EQ(distance(solve(c, options, invalid)), 1);
  EXPECT_EQ(solve(c, options, invalid).cost, first.cost + 1);
}

TEST(ObjectPaths, AmongPathsThatAreCheapEnoughThoseFarFromWhatStaysComeFirst) {
  // To the near side is one step less than to the far side, but there a post stands close by.
  ShelfCase c = empty_shelf({0.7, -0.5, 0.85}, {0.5, 0.1, 0.1});
  add(c, standing_cylinder("a", 0.7, -0.49, 0.03, 0.15));
  add(c, standing_cylinder("post", 0.7, -0.33, 0.03, 0.15, ObjectKind::immovable));
  ObjectPathsOptions options;
  options.suboptimality = 1;
  EXPECT_GT(solve(c, options).paths.at(0).goal.y, -49);
  options.suboptimality = 2;
  EXPECT_LT(solve(c, options).paths.at(0).goal.y, -49);
}

TEST(ObjectPaths, WhatFellOffTheShelfStaysWhereItIs) {
  ShelfCase c = empty_shelf({0.7, -0.5, 0.85}, {0.2, 0.1, 0.1});
  add(c, standing_cylinder("a", 0.7, -0.5, 0.03, 0.15));
  const ObjectId fallen = add(c, standing_cylinder("fallen", 0.3, -0.5, 0.03, 0.15));
  Eigen::Isometry3d X = c.state.X_WO(fallen);
  X.translation().z() = 0.075;
  c.state[fallen] = quantise(X);
  const ObjectPathsResult result = solve(c);
  ASSERT_TRUE(result.solved);
  EXPECT_EQ(result.paths.size(), 1u);
}

TEST(ObjectPaths, ClearOfIsWhatTheSearchGoesBy) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ShelfCase c = test::shelf_case(10, 4, seed);
    const ObjectPathFinder finder(c.problem, c.target, {});
    bool all_clear = true;
    for (const ObjectId id : ObjectSet::of_kind(c.problem.scene, ObjectKind::movable).ids()) {
      const bool clear = finder.clear_of(c.region, id, c.state);
      all_clear = all_clear && clear;
      EXPECT_FALSE(clear && c.region.overlap(c.problem.scene[id], c.state.X_WO(id)).common_cells > 0);
    }
    EXPECT_EQ(finder.solve(c.state, c.region, {}, nullptr).paths.empty(), all_clear);
  }
}

TEST(ObjectPaths, CallsOnSeveralThreadsGiveWhatOneGives) {
  std::vector<ShelfCase> cases;
  for (std::uint64_t seed = 0; seed < 4; ++seed) cases.push_back(test::shelf_case(12, 4, 5));
  const ObjectPathFinder finder(cases[0].problem, cases[0].target, {});
  const auto cells = [&](const WorldState& state) {
    std::vector<std::vector<GridCell>> out;
    for (const ObjectPath& p : finder.solve(state, cases[0].region, {}, nullptr).paths) out.push_back(p.cells);
    return out;
  };
  const auto alone = [&] {
    const ObjectPathFinder fresh(cases[0].problem, cases[0].target, {});
    std::vector<std::vector<GridCell>> out;
    for (const ObjectPath& p : fresh.solve(cases[0].state, cases[0].region, {}, nullptr).paths) out.push_back(p.cells);
    return out;
  }();
  EXPECT_FALSE(alone.empty());
  std::vector<std::thread> threads;
  std::vector<int> same(4, 0);
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 5; ++k) same[t] += cells(cases[0].state) == alone;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_THAT(same, ElementsAre(5, 5, 5, 5));
}

TEST(ObjectPaths, BudgetsAndStopRequestsEndACall) {
  const ShelfCase c = test::shelf_case(15, 4, 0);
  ObjectPathsOptions options;
  options.max_expansions = 10;
  const ObjectPathsResult small = solve(c, options);
  EXPECT_FALSE(small.solved);
  EXPECT_TRUE(small.budget_used_up);
  StopSource stop;
  stop.request(StopReason::interrupted);
  const ObjectPathFinder finder(c.problem, c.target, {});
  EXPECT_TRUE(finder.solve(c.state, c.region, {}, &stop).stopped);
}

}  // namespace
}  // namespace mamo
