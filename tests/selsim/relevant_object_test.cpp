#include "mamo/selsim/relevant_object.hpp"

#include "support/fixtures.hpp"

namespace mamo {
namespace {

//  robot -> 1 -> 2 -> 3(violated)      fixtures take no part
struct RelevantObjectTest : testing::Test {
  RelevantObjectTest() {
    scene.objects.push_back(fixtures::fixture_box("table", {0, 0, 0}, {1, 1, 0.1}, Touch::support));
    for (int k = 1; k <= 5; ++k)
      scene.objects.push_back(fixtures::standing_cylinder("o" + std::to_string(k), k, 0, 0.03, 0.1));
  }
  static Interaction pair(int a, int b, double t) { return {ObjectId(a), ObjectId(b), t}; }
  ObjectSet set(std::initializer_list<int> ids) const {
    ObjectSet s(scene.size());
    for (int id : ids) s.insert(ObjectId(id));
    return s;
  }
  Scene scene;
};

TEST_F(RelevantObjectTest, TheViolatedObjectItselfComesFirst) {
  EXPECT_EQ(relevant_object({pair(2, 3, 0.1)}, ObjectId(3), set({}), scene), ObjectId(3));
}

TEST_F(RelevantObjectTest, TheNearestIrrelevantObjectIsFoundBreadthFirst) {
  const std::vector<Interaction> p = {pair(1, 2, 0.1), pair(2, 3, 0.2), pair(1, 4, 0.0)};
  EXPECT_EQ(relevant_object(p, ObjectId(3), set({3}), scene), ObjectId(2));
  EXPECT_EQ(relevant_object(p, ObjectId(3), set({2, 3}), scene), ObjectId(1));
  EXPECT_EQ(relevant_object(p, ObjectId(3), set({1, 2, 3}), scene), ObjectId(4));
}

TEST_F(RelevantObjectTest, AtEqualDepthTheEarlierContactComesFirstThenTheSmallerId) {
  EXPECT_EQ(relevant_object({pair(3, 4, 0.5), pair(3, 5, 0.2)}, ObjectId(3), set({3}), scene), ObjectId(5));
  EXPECT_EQ(relevant_object({pair(3, 5, 0.2), pair(3, 4, 0.2)}, ObjectId(3), set({3}), scene), ObjectId(4));
}

TEST_F(RelevantObjectTest, RobotAndFixturesAreNoNodes) {
  const std::vector<Interaction> p = {
      {kRobot, ObjectId(3), 0.0}, {kRobot, ObjectId(5), 0.0}, pair(0, 3, 0.0), pair(0, 4, 0.0)};
  EXPECT_EQ(relevant_object(p, ObjectId(3), set({3}), scene), kNoObject);
  EXPECT_EQ(relevant_object(p, ObjectId(0), set({}), scene), kNoObject);
}

TEST_F(RelevantObjectTest, ACycleOfRelevantObjectsEnds) {
  EXPECT_EQ(relevant_object({pair(1, 2, 0.1), pair(2, 3, 0.2), pair(1, 3, 0.3)}, ObjectId(3), set({1, 2, 3}), scene),
            kNoObject);
}

}  // namespace
}  // namespace mamo
