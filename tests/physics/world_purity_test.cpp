// A world is a pure function of what reset() was given and of the steps since, bit for bit.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <thread>

#include "mamo/physics/world.hpp"
#include "support/shelf_pushes.hpp"

namespace mamo {
namespace {

using namespace pushing;

constexpr std::uint64_t kSeed = 20240611;

class WorldPurity : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ = new Scene(permissive_shelf(15, 5, 3));
    pushes_ = new std::vector<Push>(random_pushes(*scene_, 40, kSeed));
    expected_ = new std::vector<std::uint64_t>;
    for (const Push& push : *pushes_) {
      World fresh(gripper_gantry(), *scene_);
      expected_->push_back(run_bits(fresh, push, scene_->physics.step));
    }
  }
  static void TearDownTestSuite() {
    delete scene_;
    delete pushes_;
    delete expected_;
  }

  /// Runs `count` pushes in random order in one world; the number that differ from a fresh world.
  static int mismatches(int count, std::uint64_t order) {
    World world(gripper_gantry(), *scene_);
    RandomStream random(kSeed, {order});
    int wrong = 0;
    for (int k = 0; k < count; ++k) {
      const std::size_t i = random.below(pushes_->size());
      wrong += run_bits(world, (*pushes_)[i], scene_->physics.step) != (*expected_)[i];
    }
    return wrong;
  }

  static Scene* scene_;
  static std::vector<Push>* pushes_;
  static std::vector<std::uint64_t>* expected_;
};
Scene* WorldPurity::scene_ = nullptr;
std::vector<Push>* WorldPurity::pushes_ = nullptr;
std::vector<std::uint64_t>* WorldPurity::expected_ = nullptr;

TEST_F(WorldPurity, DifferentPushesHaveDifferentBits) {
  const std::set<std::uint64_t> distinct(expected_->begin(), expected_->end());
  EXPECT_EQ(distinct.size(), pushes_->size()) << "seed " << kSeed;
}

TEST_F(WorldPurity, AThousandInterleavingsEqualFreshWorldsOnOneThread) {
  EXPECT_EQ(mismatches(1000, 1), 0) << "seed " << kSeed;
}

TEST_F(WorldPurity, AThousandInterleavingsEqualFreshWorldsOnFourThreads) {
  std::array<int, 4> wrong{};
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 4; ++t) threads.emplace_back([&wrong, t] { wrong[t] = mismatches(250, 10 + t); });
  }
  EXPECT_EQ(wrong, (std::array<int, 4>{})) << "seed " << kSeed;
}

TEST_F(WorldPurity, AnEvaluationCutShortLeavesNothingBehind) {
  World world(gripper_gantry(), *scene_);
  RandomStream random(kSeed, {99});
  for (int k = 0; k < 60; ++k) {
    Push cut = (*pushes_)[random.below(pushes_->size())];
    const double end = random.uniform(0.3, 1.0) * cut.motion.duration();
    Eigen::VectorXd q;
    cut.motion.at(end, q);
    cut.motion = TimedPath{{0, end}, {cut.motion.q.front(), q}};
    run_bits(world, cut, scene_->physics.step);
    if (k % 3 == 0) world.attach(cut.present.ids().front(), LinkId{3}), world.step(q);
    if (k % 3 == 1) world.ignore_robot(cut.present.ids().back()), world.step(q);
    const std::size_t i = random.below(pushes_->size());
    ASSERT_EQ(run_bits(world, (*pushes_)[i], scene_->physics.step), (*expected_)[i]) << "seed " << kSeed << " k " << k;
  }
}

TEST_F(WorldPurity, ObjectsThatNeverStirChangeNothingByBeingPresent) {
  World world(gripper_gantry(), *scene_);
  int smaller = 0;
  for (const Push& push : *pushes_) {
    Push projected = push;
    std::set<ObjectId> stirred;
    world.reset(push.present, push.from, push.motion.q.front());
    for (const Eigen::VectorXd& q : sampled(push.motion, scene_->physics.step)) {
      world.step(q);
      for (const ObjectId id : push.present.ids())
        if (world.awake(id)) stirred.insert(id);
    }
    for (const ObjectId id : push.present.ids())
      if (!stirred.contains(id)) projected.present.erase(id), ++smaller;
    EXPECT_EQ(run_bits(world, projected, scene_->physics.step), run_bits(world, push, scene_->physics.step));
  }
  EXPECT_GT(smaller, 100);
}

TEST_F(WorldPurity, StepsInFreeAirChangeNothing) {
  World world(gripper_gantry(), *scene_);
  for (const Push& push : *pushes_) {
    const Eigen::VectorXd mouth = push.motion.q.front();
    world.reset(push.present, push.from, mouth - Eigen::Vector3d(0.1, 0, 0));
    for (const Eigen::VectorXd& q : sampled(along({mouth - Eigen::Vector3d(0.1, 0, 0), mouth}), scene_->physics.step))
      world.step(q);
    const std::uint64_t after_approach = step_bits(world, sampled(push.motion, scene_->physics.step));
    EXPECT_EQ(after_approach, run_bits(world, push, scene_->physics.step));
  }
}

}  // namespace
}  // namespace mamo
