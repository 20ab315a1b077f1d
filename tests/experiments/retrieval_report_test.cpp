// Reports of retrieval campaigns: solved by difficulty, the published numbers beside, box plots and stacks.
#include <gmock/gmock.h>

#include "experiments/published_em4m.hpp"
#include "mamo/experiments/category_chart.hpp"
#include "mamo/experiments/ompl_log.hpp"
#include "mamo/experiments/report.hpp"

namespace mamo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Record record(const std::string& planner, const std::string& difficulty, int problem, bool solved, bool found) {
  Record r;
  r.suite = "s";
  r.setting = "shelf";
  r.planner = r.label = planner;
  r.problem = "p" + std::to_string(problem);
  r.run = planner + difficulty + r.problem;
  r.status = solved ? "solved" : "timeout";
  r.solved = solved;
  r.found = found;
  r.difficulty = difficulty;
  r.difficulty_listed = difficulty == "easy" ? "medium" : "hard";
  r.time_s = solved ? 2.0 + problem : 30;
  r.time_limit_s = 30;
  r.mapf_s = 1;
  r.push_planning_s = 5;
  r.simulation_s = 0.5;
  r.pushes = solved ? 3 : 0;
  r.started = "2026-01-01T00:00:00Z";
  r.machine = "{}";
  return r;
}

std::vector<Record> records() {
  std::vector<Record> all;
  for (int k = 0; k < 4; ++k) {
    all.push_back(record("em4m", "easy", k, true, true));
    all.push_back(record("m4m", "easy", k, k < 2, k < 3));
    all.push_back(record("em4m", "hard", 10 + k, k < 1, k < 1));
    all.push_back(record("m4m", "hard", 10 + k, k < 2, k < 2));
  }
  return all;
}

const Table* table(const Report& report, const std::string& name) {
  for (const Table& t : report.tables)
    if (t.name == name) return &t;
  return nullptr;
}

TEST(RetrievalReport, CountsWhatIsSolvedByDifficultyBesideThePaper) {
  const Report report = make_report(records());
  const Table* solved = table(report, "s-solved");
  ASSERT_NE(solved, nullptr);
  EXPECT_THAT(solved->header, ElementsAre("difficulty", "em4m", "paper", "m4m", "paper"));
  ASSERT_EQ(solved->rows.size(), 2u);
  EXPECT_THAT(solved->rows[0], ElementsAre("easy", "4/4", "0.99", "2/4 (found 3)", "0.80"));
  EXPECT_THAT(solved->rows[1], ElementsAre("hard", "1/4", "0.38", "2/4", "0.18"));
}

TEST(RetrievalReport, ClassesOfTheListAreATableOfTheirOwn) {
  const Report report = make_report(records());
  const Table* listed = table(report, "s-solved-listed");
  ASSERT_NE(listed, nullptr);
  EXPECT_EQ(listed->rows[0][0], "medium");
  EXPECT_EQ(listed->rows[0][1], "4/4");
}

TEST(RetrievalReport, SaysWhereTheOrderOfThePlannersIsNotThePapers) {
  const Report report = make_report(records());
  const Table* order = table(report, "s-order");
  ASSERT_NE(order, nullptr);
  EXPECT_THAT(order->rows[0], ElementsAre("easy", "1", "1", ""));
  EXPECT_THAT(order->rows[1], ElementsAre("hard", "1", "0", "m4m above em4m"));
}

TEST(RetrievalReport, DrawsBoxesAndStacksOnPageAndInMarkdown) {
  const Report report = make_report(records());
  ASSERT_EQ(report.figures.size(), 3u);
  for (const Figure& figure : report.figures) {
    EXPECT_THAT(figure.svg, HasSubstr("<rect"));
    EXPECT_THAT(to_html(report), HasSubstr(figure.title));
    EXPECT_THAT(to_markdown(report), HasSubstr(figure.name + ".svg"));
  }
  EXPECT_THAT(report.figures[0].svg, HasSubstr("em4m: median 3"));
  EXPECT_THAT(report.figures[2].svg, HasSubstr("push planner: 5"));
}

TEST(RetrievalReport, OtherSuitesHaveNoneOfIt) {
  std::vector<Record> all = records();
  for (Record& r : all) r.difficulty.clear();
  const Report report = make_report(all);
  EXPECT_EQ(table(report, "s-solved"), nullptr);
  EXPECT_TRUE(report.figures.empty());
}

TEST(PublishedEm4m, HoldsTheSharesOfTheTables) {
  EXPECT_EQ(published_em4m("fullsim"), nullptr);
  EXPECT_NEAR(*published_em4m("em4m")->share("medium"), 45.0 / 63, 1e-12);
  EXPECT_EQ(published_em4m("em4m")->share("none"), std::nullopt);
}

TEST(OmplLog, HasALineForEveryRunAndPropertiesInOrder) {
  const auto logs = ompl_logs(records());
  ASSERT_EQ(logs.size(), 1u);
  EXPECT_EQ(logs[0].first, "s_shelf.log");
  const std::string& text = logs[0].second;
  EXPECT_THAT(text, HasSubstr("Experiment s_shelf\n"));
  EXPECT_THAT(text, HasSubstr("2 planners\nem4m\n"));
  EXPECT_THAT(text, HasSubstr("time REAL\nsolved BOOLEAN\nstatus ENUM\n"));
  EXPECT_THAT(text, HasSubstr("8 runs\n2; 1; 0; 1; "));
}

}  // namespace
}  // namespace mamo
