#include "mamo/collision/collision_checker.hpp"

#include "support/robots.hpp"

namespace mamo {
namespace {

TEST(CollisionChecker, HomeIsFreeOnTheShelf) {
  const Robot robot = fixtures::pr2_like_arm();
  const Scene scene = fixtures::cluttered_shelf(10, 5, 1);
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), scene);
  CollisionReport report;
  ObjectSet all(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) all.insert(ObjectId(i));
  checker.check(robot.group_part(robot.posture), all, false, report);
  EXPECT_TRUE(report.free());
  EXPECT_TRUE(checker.overlapping_objects(0.001).empty());
}

}  // namespace
}  // namespace mamo
