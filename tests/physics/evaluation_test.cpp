#include "mamo/physics/evaluation.hpp"

#include <gmock/gmock.h>

#include "support/pusher.hpp"

namespace mamo {
namespace {

using namespace pushing;

/// Finger height at which a can slides rather than tips.
constexpr double kLow = kTop + 0.025;

//      finger -> (can)
TEST(Evaluation, APushMovesTheObjectInFrontOfTheFinger) {
  Bench bench{table()};
  const ObjectId a = add(bench.scene, can("a", 0.1, 0));
  const Evaluation e = bench.evaluate(along({{0, 0, kLow}, {0.2, 0, kLow}}));
  ASSERT_TRUE(e.valid) << to_string(e.violation->kind) << " " << e.violation->value;
  const Eigen::Vector3d p = e.state.X_WO(a).translation();
  EXPECT_NEAR(p.x(), 0.2 + 0.02 + 0.035, 0.003);
  EXPECT_NEAR(p.z(), kTop + 0.05, 0.001);
  EXPECT_THAT(e.interactions, testing::SizeIs(1));
  EXPECT_FALSE(e.second_order);
}

}  // namespace
}  // namespace mamo
