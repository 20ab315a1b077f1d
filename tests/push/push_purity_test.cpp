// An outcome is a function of problem, options, seed and request: whatever ran before, on whichever thread.
#include <gtest/gtest.h>

#include <thread>

#include "support/push_problem.hpp"

#include "mamo/common/hash.hpp"

namespace mamo {
namespace {

using namespace fixtures;

constexpr std::uint64_t kSeed = 77;

std::uint64_t bits(const PushOutcome& out) {
  HashStream hash;
  hash.add(static_cast<std::int32_t>(out.failure));
  for (const auto* path : {&out.approach, &out.push, &out.retreat})
    for (const Eigen::VectorXd& q : *path)
      for (const double value : q) hash.add(value);
  for (const QuantisedPose& pose : out.after.poses) {
    for (const std::int32_t v : pose.p) hash.add(v);
    for (const std::int32_t v : pose.q) hash.add(v);
  }
  hash.add(out.settle_s);
  hash.add(out.share);
  hash.add(static_cast<std::int32_t>(out.simulations));
  hash.add(out.collision_checks);
  for (const ObjectId id : out.moved) hash.add(id.value);
  return hash.value();
}

class PushPurity : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    problem_ = new Problem(push_problem(cluttered_shelf(8, 3, 5)));
    kinematics_ = std::make_shared<ForwardKinematics>(problem_->robot);
    requests_ = new std::vector<PushRequest>(push_requests(*problem_));
    while (requests_->size() > 24) requests_->pop_back();
    for (std::size_t i = 0; i < requests_->size(); ++i) (*requests_)[i].attempt = static_cast<int>(i % 3);
    expected_ = new std::vector<std::uint64_t>;
    valid_ = 0;
    for (const PushRequest& request : *requests_) {
      PushPlanner fresh(*problem_, kinematics_, {}, kSeed);
      const PushOutcome out = fresh.attempt(request, nullptr, nullptr);
      valid_ += out.valid();
      expected_->push_back(bits(out));
    }
  }
  static void TearDownTestSuite() {
    delete problem_;
    delete requests_;
    delete expected_;
    kinematics_.reset();
  }
  /// Requests in random order by one planner; how many differ from a fresh planner's answer.
  static int mismatches(int count, std::uint64_t order) {
    PushPlanner planner(*problem_, kinematics_, {}, kSeed);
    RandomStream random(kSeed, {order});
    int wrong = 0;
    for (int k = 0; k < count; ++k) {
      const std::size_t i = random.below(requests_->size());
      wrong += bits(planner.attempt((*requests_)[i], nullptr, nullptr)) != (*expected_)[i];
    }
    return wrong;
  }

  static inline Problem* problem_;
  static inline std::shared_ptr<const ForwardKinematics> kinematics_;
  static inline std::vector<PushRequest>* requests_;
  static inline std::vector<std::uint64_t>* expected_;
  static inline int valid_;
};

TEST_F(PushPurity, AnyOrderGivesWhatAFreshPlannerGives) {
  EXPECT_GE(valid_, 3) << "of " << requests_->size() << ": too few to say anything";
  EXPECT_EQ(mismatches(80, 1), 0) << "seed " << kSeed;
}

TEST_F(PushPurity, TwoThreadsGiveWhatOneGives) {
  int wrong[2] = {0, 0};
  std::thread a([&] { wrong[0] = mismatches(40, 2); }), b([&] { wrong[1] = mismatches(40, 3); });
  a.join();
  b.join();
  EXPECT_EQ(wrong[0] + wrong[1], 0) << "seed " << kSeed;
}

TEST_F(PushPurity, AttemptsDiffer) {
  PushPlanner planner(*problem_, kinematics_, {}, kSeed);
  PushRequest request = requests_->front();
  std::vector<std::uint64_t> seen;
  for (request.attempt = 0; request.attempt < 4; ++request.attempt) {
    const PushOutcome out = planner.attempt(request, nullptr, nullptr);
    if (out.valid()) seen.push_back(bits(out));
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_TRUE(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
}

}  // namespace
}  // namespace mamo
