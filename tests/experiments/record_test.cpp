#include "mamo/experiments/record.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mamo/experiments/report.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

Suite suite() {
  Suite s;
  s.name = "small";
  ProblemSource source;
  source.kind = ProblemSource::Kind::tabletop;
  source.count = 4;
  source.tabletop.movable = 10;
  source.tabletop.immovable = 2;
  s.problems = {source};
  PlannerEntry entry;
  entry.name = entry.label = "selsim";
  entry.weight = 20;
  s.planners = {entry};
  return s;
}

std::string line_of(const Suite& s, const BenchRun& run, PlanStatus status = PlanStatus::solved) {
  PlanResult result;
  result.planner = "selsim";
  result.status = status;
  result.found = result.verified = status == PlanStatus::solved;
  result.reason = status == PlanStatus::solved ? "" : "too <hard>";
  result.stats.wall_s = 1.5;
  result.stats.load_s = 0.5;
  result.stats.simulations_used = 12;
  Problem problem;
  problem.name = "p" + std::to_string(run.problem);
  problem.generated["goal_redraws"] = "2";
  return bench_line(s, run, result, problem, {R"({"processor": "x"})", "abc"}, "2026-01-01T00:00:00Z", true);
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BenchLine, IsAResultWithTheRunsFieldsBehindIt) {
  const Suite s = suite();
  const auto json = nlohmann::json::parse(line_of(s, runs_of(s)[1]));
  EXPECT_EQ(json["schema"], "mamo-result/1");
  EXPECT_TRUE(json["plan"].contains("segments"));
  EXPECT_EQ(json["suite"], "small");
  EXPECT_EQ(json["commit"], "abc");
  EXPECT_EQ(json["started"], "2026-01-01T00:00:00Z");
  EXPECT_EQ(json["machine"]["processor"], "x");
  EXPECT_EQ(json["limits"]["time"], 120);
  EXPECT_TRUE(json["limits"]["simulations"].is_null());
}

TEST(BenchLine, ReadsBack) {
  const Suite s = suite();
  const BenchRun run = runs_of(s)[1];
  const auto record = parse_record(line_of(s, run), "x:1");
  ASSERT_TRUE(record.ok()) << record.error().message;
  EXPECT_EQ(record->run, run.id);
  EXPECT_EQ(record->settings, run.settings);
  EXPECT_TRUE(record->solved);
  EXPECT_EQ(record->time_s, 1.0) << "loading does not count";
  EXPECT_EQ(record->simulations, 12);
  EXPECT_EQ(record->redraws, 2);
  EXPECT_EQ(record->weight, 20);
  EXPECT_EQ(record->time_limit_s, 120);
}

TEST(BenchLine, MalformedOnesAreNamed) {
  for (const char* text : {"", "{", "[]", "{}", R"({"suite": 3})"}) {
    const auto record = parse_record(text, "r.jsonl:7");
    ASSERT_FALSE(record.ok()) << text;
    EXPECT_THAT(record.error().message, testing::StartsWith("r.jsonl:7: "));
  }
}

TEST(RecordFile, GoesOnAfterATornLine) {
  const Suite s = suite();
  const auto runs = runs_of(s);
  const test::ScratchFolder folder;
  const std::string whole = line_of(s, runs[0]) + "\n", torn = line_of(s, runs[1]);
  for (std::size_t cut : {std::size_t{0}, std::size_t{1}, torn.size() / 2, torn.size()}) {
    const std::string path = folder.write("r.jsonl", whole + torn.substr(0, cut));
    {
      RecordFile file;
      ASSERT_TRUE(file.open(path, true).ok()) << cut;
      EXPECT_TRUE(*file.done(runs[0]));
      EXPECT_FALSE(*file.done(runs[1])) << cut;
      ASSERT_TRUE(file.append(line_of(s, runs[1])).ok());
    }
    EXPECT_EQ(content(path), whole + torn + "\n") << cut;
    EXPECT_EQ(read_records(path)->size(), 2u);
  }
}

TEST(RecordFile, DoesNotAddToResultsUnasked) {
  const Suite s = suite();
  const test::ScratchFolder folder;
  const std::string path = folder.write("r.jsonl", line_of(s, runs_of(s)[0]) + "\n");
  const std::string before = content(path);
  RecordFile file;
  const Status status = file.open(path, false);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::usage);
  EXPECT_EQ(content(path), before);
}

TEST(RecordFile, RefusesAnotherVersionOfTheSuite) {
  Suite s = suite();
  const test::ScratchFolder folder;
  const std::string path = folder.write("r.jsonl", line_of(s, runs_of(s)[0]) + "\n");
  s.planners[0].limits.time_s = 5;
  RecordFile file;
  ASSERT_TRUE(file.open(path, true).ok());
  EXPECT_FALSE(file.done(runs_of(s)[0]).ok());
  EXPECT_TRUE(file.done(runs_of(s)[1]).ok()) << "not in the file";
}

TEST(RecordFile, RefusesAFileThatAnotherWrites) {
  const test::ScratchFolder folder;
  const std::string path = folder.path() + "/r.jsonl";
  RecordFile first, second;
  ASSERT_TRUE(first.open(path, true).ok());
  const Status status = second.open(path, true);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::output);
}

TEST(Report, DoesNotDependOnTheOrderOfLinesNorOnRepeatedOnes) {
  Suite s = suite();
  PlannerEntry other;
  other.name = other.label = "fullsim";
  s.planners.push_back(other);
  std::vector<Record> records;
  for (const BenchRun& run : runs_of(s)) {
    records.push_back(
        *parse_record(line_of(s, run, run.problem == 2 ? PlanStatus::timeout : PlanStatus::solved), "x:1"));
    records.back().planner = s.planners[run.planner].name;
    records.back().movable = 10;
    records.back().immovable = 2;
  }
  std::vector<Record> backwards(records.rbegin(), records.rend());
  backwards.push_back(records.front());
  const Report a = make_report(records), b = make_report(backwards);
  EXPECT_EQ(to_html(a), to_html(b));
  EXPECT_EQ(to_markdown(a), to_markdown(b));
  ASSERT_EQ(a.tables.size(), 4u);
  EXPECT_EQ(a.tables[0].rows[0][3], "3/4");
  const auto& row = a.tables[0].rows[0];
  EXPECT_EQ(row[row.size() - 2], "0.92") << "published beside ours";
  EXPECT_EQ(row.back(), "3.23");
  EXPECT_THAT(to_html(a), testing::AllOf(testing::HasSubstr("too &lt;hard&gt;"), testing::HasSubstr("<svg"),
                                         testing::HasSubstr("prefers-color-scheme: dark")));
}

TEST(Report, LeadsFromEveryRunToItsPageWhereThereIsOne) {
  std::vector<Record> records;
  const Suite s = suite();
  for (const BenchRun& run : runs_of(s)) records.push_back(*parse_record(line_of(s, run), "x:1"));
  const std::string first = records.front().run;
  const Report report = make_report(records, [&](const Record& r) {
    return r.run == first ? "pages/" + page_file_name(r.run) : std::string();
  });
  const std::string page = to_html(report);
  EXPECT_THAT(page, testing::HasSubstr("href=\"pages/" + page_file_name(first) + "\""));
  EXPECT_EQ(page.find("href=\"pages/"), page.rfind("href=\"pages/"));
  EXPECT_THAT(to_markdown(report), testing::Not(testing::HasSubstr("every run")));
}

TEST(Report, PagesOfDifferentRunsHaveDifferentPlainNames) {
  EXPECT_NE(page_file_name("a/b"), page_file_name("a b"));
  EXPECT_EQ(page_file_name("../x y/1").find_first_of("/ "), std::string::npos);
  EXPECT_NE(page_file_name("../x")[0], '/');
}

TEST(Report, QuotesCsvCells) {
  Table table;
  table.header = {"a", "b"};
  table.rows = {{"x, \"y\"", "z"}};
  EXPECT_EQ(to_csv(table), "a,b\n\"x, \"\"y\"\"\",z\n");
}

}  // namespace
}  // namespace mamo
