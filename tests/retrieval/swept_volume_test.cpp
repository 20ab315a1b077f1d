// The negative goal region against points of the arm and of the carried object, sampled on their surfaces and insides.
#include <gtest/gtest.h>

#include "support/retrieve_problem.hpp"

#include "mamo/common/random.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class SweptVolume : public testing::Test {
 protected:
  SweptVolume()
      : setup(retrieve_problem(cluttered_shelf(5, 0, 3), target_can())), space(object_space(setup.problem.scene)) {
    path = *setup.plan(setup.nothing).path;
    volume = swept_volume(setup.problem, *setup.kinematics, path, setup.grasp_of(path), setup.state, space, 0.01);
  }

  /// A point inside the shape, in its frame: uniform in the box about it, drawn again until it is inside.
  static Eigen::Vector3d inside(const Shape& shape, RandomStream& random) {
    const Eigen::AlignedBox3d box = bounds(shape, Eigen::Isometry3d::Identity());
    for (;;) {
      Eigen::Vector3d p;
      for (int a = 0; a < 3; ++a) p[a] = random.uniform(box.min()[a], box.max()[a]);
      if (signed_distance(shape, p) <= 0) return p;
    }
  }

  RetrievalSetup setup;
  Eigen::AlignedBox3d space;
  RetrievalPath path;
  VoxelVolume volume;
};

TEST_F(SweptVolume, HoldsEveryPointOfArmAndHeldObjectAlongTheWholePath) {
  RandomStream random(7, {0x7377});
  const Robot& robot = setup.problem.robot;
  const std::vector<bool> moves = robot.moving_links();
  const Object& target = setup.problem.scene[std::get<Retrieve>(setup.problem.task).object];
  const Eigen::Isometry3d X_TO = setup.kinematics->tip_pose(path.reach.back()).inverse() * target.X_WO;
  int looked_at = 0;
  std::vector<Eigen::Isometry3d> X_WL;
  const auto expect_marked = [&](const Shape& shape, const Eigen::Isometry3d& X_WS, const char* what) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = X_WS * inside(shape, random);
      if (!space.contains(p)) continue;
      ++looked_at;
      // A point's cell counts as swept when its centre is within half a cell; a corner of a cell is further away.
      bool marked = volume.contains(p);
      for (int a = 0; a < 3 && !marked; ++a)
        for (double d : {-0.005, 0.005})
          marked = marked || volume.contains(Eigen::Vector3d(p + d * Eigen::Vector3d::Unit(a)));
      ASSERT_TRUE(marked) << what << " at " << p.transpose();
    }
  };
  for (const auto* leg : {&path.approach, &path.reach, &path.extract}) {
    for (const Eigen::VectorXd& q : subdivided(*leg, 0.02)) {
      setup.kinematics->link_poses(q, X_WL);
      for (std::size_t i = 0; i < moves.size(); ++i)
        if (moves[i])
          for (const PlacedShape& s : robot.model->links[i].collision)
            expect_marked(s.shape, X_WL[i] * s.X_BS, robot.model->links[i].name.c_str());
      if (leg == &path.extract)
        for (const PlacedShape& s : target.shapes)
          expect_marked(s.shape, X_WL[robot.group.tip.index()] * X_TO * s.X_BS, "the held object");
    }
  }
  EXPECT_GT(looked_at, 1000);
}

TEST_F(SweptVolume, HoldsNothingFarFromThePath) {
  // The distance from each marked cell to the nearest shape along a dense path is below a cell's diagonal.
  std::vector<std::pair<const Shape*, Eigen::Isometry3d>> shapes;
  const Robot& robot = setup.problem.robot;
  const std::vector<bool> moves = robot.moving_links();
  const Object& target = setup.problem.scene[std::get<Retrieve>(setup.problem.task).object];
  const Eigen::Isometry3d X_TO = setup.kinematics->tip_pose(path.reach.back()).inverse() * target.X_WO;
  std::vector<Eigen::Isometry3d> X_WL;
  for (const auto* leg : {&path.approach, &path.reach, &path.extract})
    for (const Eigen::VectorXd& q : subdivided(*leg, 0.02)) {
      setup.kinematics->link_poses(q, X_WL);
      for (std::size_t i = 0; i < moves.size(); ++i)
        if (moves[i])
          for (const PlacedShape& s : robot.model->links[i].collision) shapes.emplace_back(&s.shape, X_WL[i] * s.X_BS);
      if (leg == &path.extract)
        for (const PlacedShape& s : target.shapes)
          shapes.emplace_back(&s.shape, X_WL[robot.group.tip.index()] * X_TO * s.X_BS);
    }
  RandomStream random(11, {0x7377});
  for (int k = 0; k < 400;) {
    Eigen::Vector3i i;
    for (int a = 0; a < 3; ++a) i[a] = static_cast<int>(random.below(static_cast<std::uint64_t>(volume.size()[a])));
    if (!volume.contains(i)) continue;
    ++k;
    double nearest = 1;
    for (const auto& [shape, X_WS] : shapes)
      nearest = std::min(nearest, signed_distance(*shape, X_WS.inverse() * volume.centre_of(i)));
    ASSERT_LT(nearest, 0.015);
  }
}

TEST_F(SweptVolume, WhatStandsWhereTheObjectWasOverlapsAndWhatStandsFarAwayDoesNot) {
  const Object& target = setup.problem.scene[std::get<Retrieve>(setup.problem.task).object];
  const VoxelVolume::Overlap own = volume.overlap(target, target.X_WO);
  EXPECT_GT(own.common_cells, own.object_cells * 9 / 10);
  EXPECT_EQ(volume.overlap(target, at(1.0, -0.2, target.X_WO.translation().z())).common_cells, 0);
}

TEST(ObjectSpace, SpansTheSupportAndIsAsHighAsTheTallestObject) {
  Scene scene = shelf();
  scene.objects.push_back(standing_cylinder("tall", 0.7, -0.5, 0.04, 0.3));
  scene.objects.push_back(standing_cylinder("low", 0.6, -0.3, 0.04, 0.1));
  const Eigen::AlignedBox3d space = object_space(scene);
  EXPECT_TRUE(space.min().isApprox(Eigen::Vector3d(0.48, -0.9, 0.77), 1e-9)) << space.min().transpose();
  EXPECT_TRUE(space.max().isApprox(Eigen::Vector3d(1.08, -0.1, 1.07), 1e-9)) << space.max().transpose();
}

}  // namespace
}  // namespace mamo
