// Planning notes and results, written and read back.
#include <gmock/gmock.h>

#include "support/sample_problem.hpp"
#include "support/scratch_folder.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/result_json.hpp"

namespace mamo {
namespace {

class Notes : public testing::Test {
 protected:
  Notes() {
    result.status = PlanStatus::solved;
    result.planner = "selsim";
    result.reason = "";
    result.plan = fixtures::sample_plan(problem);
    result.stats.relevant_objects = {ObjectId{6}, ObjectId{5}};
    result.stats.failures["robot_touch"] = 3;
    NoteLayer layer{"relevant objects", "in order", {}, {}};
    layer.items.push_back({"because of that", {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}, ObjectId{6}, 2});
    layer.items.push_back({"only text", {}, kNoObject, -1});
    layer.cells.cell = 0.04;
    layer.cells.origin = {1, 2, 3};
    layer.cells.indices = {{0, -1, 2}, {3, 4, 5}};
    layer.cells.values = {0.25, 1};
    result.notes.layers.push_back(layer);
  }
  Result<PlanResult> written_and_read() {
    return io::load_result(folder.write("result.json", io::result_json(result, problem)), problem);
  }

  test::ScratchFolder folder;
  Problem problem = fixtures::sample_problem();
  PlanResult result;
};

TEST_F(Notes, ComeBackAsTheyWere) {
  const auto back = written_and_read();
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back->notes.layers.size(), 1u);
  const NoteLayer &layer = back->notes.layers[0], &before = result.notes.layers[0];
  EXPECT_EQ(layer.name, before.name);
  EXPECT_EQ(layer.about, before.about);
  ASSERT_EQ(layer.items.size(), 2u);
  EXPECT_EQ(layer.items[0].text, before.items[0].text);
  EXPECT_EQ(layer.items[0].object, before.items[0].object);
  EXPECT_EQ(layer.items[0].iteration, 2);
  EXPECT_EQ(layer.items[0].points, before.items[0].points);
  EXPECT_TRUE(layer.items[1].points.empty());
  EXPECT_EQ(layer.items[1].object, kNoObject);
  EXPECT_EQ(layer.cells.cell, before.cells.cell);
  EXPECT_EQ(layer.cells.origin, before.cells.origin);
  EXPECT_EQ(layer.cells.indices, before.cells.indices);
  EXPECT_EQ(layer.cells.values, before.cells.values);
}

TEST_F(Notes, HowTheRunWentComesBackWithThem) {
  const auto back = written_and_read();
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->status, PlanStatus::solved);
  EXPECT_EQ(back->planner, "selsim");
  EXPECT_EQ(back->stats.relevant_objects, result.stats.relevant_objects);
  EXPECT_EQ(back->stats.failures, result.stats.failures);
  EXPECT_EQ(back->plan.segments.size(), result.plan.segments.size());
}

TEST_F(Notes, AreNotWrittenWhenThereAreNone) {
  result.notes = {};
  EXPECT_THAT(io::result_json(result, problem), testing::Not(testing::HasSubstr("notes")));
}

TEST_F(Notes, ARunWithoutAPlanIsReadWithItsReason) {
  result.status = PlanStatus::limit;
  result.reason = "no plan within the limit";
  result.plan = {};
  const auto back = written_and_read();
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->status, PlanStatus::limit);
  EXPECT_EQ(back->reason, result.reason);
  EXPECT_TRUE(back->plan.empty());
  EXPECT_EQ(back->notes.layers.size(), 1u);
}

TEST_F(Notes, ThatAreMalformedArePassedOver) {
  const char* texts[] = {
      R"({"status":"limit","notes":7,"plan":{"segments":[]}})",
      R"({"status":"limit","notes":{"layers":[1,{"name":3},{"about":"x"}]},"plan":{"segments":[]}})",
      R"({"status":"limit","notes":{"layers":[{"name":"a","items":[{"points":[[1,2],"x",[1,2,"y"]]},4],)"
      R"("cells":{"indices":[1,2,3,4,"x"],"values":[1,2,3]}}]},"plan":{"segments":[]}})"};
  for (const char* text : texts) {
    const auto back = io::load_result(folder.write("bad.json", text), problem);
    ASSERT_TRUE(back.ok()) << text;
    for (const NoteLayer& layer : back->notes.layers) {
      for (const NoteItem& item : layer.items) EXPECT_TRUE(item.points.empty());
      EXPECT_TRUE(layer.cells.values.empty());
    }
  }
}

TEST_F(Notes, ABarePlanIsReadAsSolvedAndABadFileIsAnError) {
  const auto bare = io::load_result(folder.write("p.json", io::plan_json(result.plan, problem.scene)), problem);
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare->status, PlanStatus::solved);
  EXPECT_FALSE(io::load_result(folder.write("x.json", "{"), problem).ok());
  EXPECT_FALSE(io::load_result(folder.path() + "/none.json", problem).ok());
}

}  // namespace
}  // namespace mamo
