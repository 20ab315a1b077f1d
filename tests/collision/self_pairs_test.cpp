#include "support/robots.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

using LinkPair = std::pair<LinkId, LinkId>;

struct Named {
  const Robot& robot;
  LinkPair operator()(const char* a, const char* b) const {
    const LinkId la = robot.model->find_link(a), lb = robot.model->find_link(b);
    return {std::min(la, lb), std::max(la, lb)};
  }
};

bool has(const std::vector<LinkPair>& pairs, const LinkPair& pair) {
  return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

TEST(SelfPairs, LeaveOutAdjacentRigidAndAlwaysCollidingLinks) {
  Robot robot = fixtures::pr2_like_arm();
  choose_self_pairs(robot, {}, false, 1);
  const Named named{robot};
  EXPECT_FALSE(has(robot.self_pairs, named("elbow_link", "forearm_link"))) << "adjacent";
  EXPECT_FALSE(has(robot.self_pairs, named("shoulder_pan_link", "upper_arm_link")))
      << "adjacent but for a link without shape";
  EXPECT_FALSE(has(robot.self_pairs, named("l_finger", "r_finger"))) << "rigid: nothing moves between them";
  EXPECT_FALSE(has(robot.self_pairs, named("palm", "l_finger")));
  EXPECT_TRUE(has(robot.self_pairs, named("torso", "palm")));
  EXPECT_TRUE(has(robot.self_pairs, named("shoulder_pan_link", "forearm_link")));
  for (const LinkPair& p : robot.self_pairs) {
    EXPECT_LT(p.first, p.second);
    EXPECT_FALSE(has(robot.disabled_pairs, p));
  }
}

TEST(SelfPairs, ThoseInCollisionAtTheStartAreDisabledAndListed) {
  Robot robot = fixtures::pr2_like_arm();
  auto model = std::make_shared<RobotModel>(*robot.model);
  const LinkId torso = model->find_link("torso");
  model->links[torso.index()].collision.push_back({Box{{3, 3, 3}}, Eigen::Isometry3d::Identity()});
  robot.model = model;
  choose_self_pairs(robot, {}, false, 1);
  const Named named{robot};
  EXPECT_TRUE(has(robot.disabled_pairs, named("torso", "palm")));
  EXPECT_FALSE(has(robot.self_pairs, named("torso", "palm")));
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), Scene{});
  CollisionReport report;
  checker.check(robot.group_part(robot.posture), {}, true, report);
  EXPECT_FALSE(report.self) << "the start is free of self-collision by construction";
}

TEST(SelfPairs, AListFromSrdfIsTakenAsComplete) {
  Robot robot = fixtures::pr2_like_arm();
  const Named named{robot};
  const LinkPair listed = named("torso", "palm");
  choose_self_pairs(robot, {{listed.second, listed.first}}, true, 1);
  EXPECT_FALSE(has(robot.self_pairs, listed)) << "in either order";
  EXPECT_TRUE(has(robot.self_pairs, named("torso", "forearm_link")));
  EXPECT_TRUE(robot.disabled_pairs.empty());
}

TEST(SelfPairs, TheSameSeedChoosesTheSamePairs) {
  Robot a = fixtures::made_up_robot(), b = fixtures::made_up_robot();
  choose_self_pairs(a, {}, false, 5);
  choose_self_pairs(b, {}, false, 5);
  EXPECT_EQ(a.self_pairs, b.self_pairs);
  EXPECT_EQ(a.disabled_pairs, b.disabled_pairs);
  EXPECT_FALSE(a.self_pairs.empty());
}

}  // namespace
}  // namespace mamo
