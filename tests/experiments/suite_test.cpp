#include "mamo/experiments/suite.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "mamo/io/load.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

const std::string kSmall = R"(format: mamo-suite/1
problems:
  - {generate: tabletop, movable: 3, immovable: 1, count: 3, seed: 7}
  - {generate: tabletop, movable: 3, immovable: 1, count: 2, seed: 7, constraints: full}
planners:
  - {name: selsim, weight: 20, set: {immovables: discovered}}
  - {name: fullsim, label: all, threads: 1, count: 1, limits: {time: 30, simulations: 500}}
limits: {time: 2, expansions: 1000}
seeds: [1, 5]
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::string message_of(const std::string& text) {
  const test::ScratchFolder folder;
  const auto suite = read_suite(folder.write("s.yaml", text));
  return suite.ok() ? "" : suite.error().message;
}

TEST(Suite, ReadsWhatItSays) {
  const test::ScratchFolder folder;
  const auto suite = read_suite(folder.write("small.yaml", kSmall));
  ASSERT_TRUE(suite.ok()) << suite.error().message;
  EXPECT_EQ(suite->name, "small");
  ASSERT_EQ(suite->problems.size(), 2u);
  EXPECT_EQ(suite->problems[0].setting(), "tabletop 3+1 contact-only");
  EXPECT_EQ(suite->problems[1].setting(), "tabletop 3+1 full");
  EXPECT_EQ(suite->problems[0].tabletop.seed, 7u);
  const PlannerEntry &first = suite->planners[0], &second = suite->planners[1];
  EXPECT_EQ(first.label, "selsim");
  EXPECT_EQ(first.weight, 20);
  EXPECT_EQ(first.set.at("immovables"), "discovered");
  EXPECT_EQ(first.limits.time_s, 2);
  EXPECT_EQ(first.limits.max_expansions, 1000);
  EXPECT_EQ(second.label, "all");
  EXPECT_EQ(second.threads, 1);
  EXPECT_EQ(second.limits.time_s, 30);
  EXPECT_EQ(second.limits.max_simulations, 500);
  EXPECT_EQ(second.limits.max_expansions, 1000) << "the suite's, where the entry says nothing";
}

TEST(Suite, RunsEveryPlannerOnEveryProblemAndSeedOnce) {
  const test::ScratchFolder folder;
  const auto suite = read_suite(folder.write("small.yaml", kSmall));
  ASSERT_TRUE(suite.ok());
  const auto runs = runs_of(*suite);
  EXPECT_EQ(runs.size(), 2u * (3 + 1) + 2u * (2 + 1)) << "the second planner takes the first problem of each source";
  std::set<std::string> ids;
  for (const BenchRun& run : runs) ids.insert(run.id);
  EXPECT_EQ(ids.size(), runs.size());
  EXPECT_EQ(runs[0].id, "small/tabletop 3+1 contact-only/7-0/selsim/1");
  EXPECT_EQ(runs.back().index, 4);
}

TEST(Suite, SettingsTellChangedLimitsAndOptionsApart) {
  const test::ScratchFolder folder;
  const auto settings = [&](const std::string& text) {
    const auto suite = read_suite(folder.write("s.yaml", text));
    EXPECT_TRUE(suite.ok());
    return runs_of(*suite)[0].settings;
  };
  const std::string same = settings(kSmall);
  EXPECT_EQ(settings(kSmall), same);
  EXPECT_NE(settings(replaced(kSmall, "time: 2", "time: 3")), same);
  EXPECT_NE(settings(replaced(kSmall, "weight: 20", "weight: 21")), same);
  EXPECT_NE(settings(replaced(kSmall, "discovered", "known")), same);
}

TEST(Suite, GeneratesTheBitsThatItsFileWouldHold) {
  const test::ScratchFolder folder;
  const auto suite = read_suite(folder.write("small.yaml", kSmall));
  ASSERT_TRUE(suite.ok());
  const auto made = problem_of(*suite, runs_of(*suite)[0]);
  ASSERT_TRUE(made.ok()) << made.error().message;
  TabletopSpec spec = suite->problems[0].tabletop;
  const auto generated = generate_tabletop(spec);
  ASSERT_TRUE(generated.ok());
  const auto text = io::to_native_yaml(*generated);
  ASSERT_TRUE(text.ok());
  const auto loaded = io::load_problem(folder.write(generated->name, *text));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(made->sha256, loaded->sha256);
  EXPECT_EQ(made->name, loaded->name);
  ASSERT_EQ(made->scene.size(), loaded->scene.size());
  for (std::size_t i = 0; i < made->scene.size(); ++i)
    EXPECT_EQ(made->scene.objects[i].X_WO.matrix(), loaded->scene.objects[i].X_WO.matrix()) << i;
}

TEST(Suite, RefusesWhatItDoesNotKnowAndNamesThePlace) {
  EXPECT_THAT(message_of(replaced(kSmall, "mamo-suite/1", "mamo-suite/9")), testing::HasSubstr("mamo-suite/1"));
  EXPECT_THAT(message_of(replaced(kSmall, "name: selsim", "name: selsym")),
              testing::AllOf(testing::HasSubstr("s.yaml:6:"), testing::HasSubstr("did you mean 'selsim'")));
  EXPECT_THAT(message_of(replaced(kSmall, "immovables:", "imovables:")), testing::HasSubstr("immovables"));
  EXPECT_THAT(message_of(replaced(kSmall, "count: 3", "count: 0")), testing::HasSubstr("count"));
  EXPECT_THAT(message_of(replaced(kSmall, "count: 3", "count: 2.5")), testing::HasSubstr("whole number"));
  EXPECT_THAT(message_of(replaced(kSmall, "time: 2", "time: 0")), testing::HasSubstr("time"));
  EXPECT_THAT(message_of(replaced(kSmall, "label: all", "label: selsim")), testing::HasSubstr("two planners"));
  EXPECT_THAT(message_of(replaced(kSmall, ", constraints: full", "")), testing::HasSubstr("stand twice"));
  EXPECT_THAT(message_of(replaced(kSmall, "seeds: [1, 5]", "sedes: [1]")), testing::HasSubstr("seeds"));
  EXPECT_THAT(message_of("format: mamo-suite/1\nproblems: {files: 'no/*.yaml'}\nplanners: {name: selsim}\n"),
              testing::HasSubstr("no file matches"));
}

TEST(Suite, ShippedSuitesAreReadAndHoldWhatThePaperMeasured) {
  const std::filesystem::path folder = std::filesystem::path(MAMO_SOURCE_DIR) / "bench/suites";
  const auto table1 = read_suite((folder / "selsim_table1.yaml").string());
  ASSERT_TRUE(table1.ok()) << table1.error().message;
  EXPECT_EQ(table1->problems[0].setting(), "tabletop 10+2 contact-only");
  EXPECT_EQ(table1->problems[0].count, 60);
  EXPECT_EQ(table1->planners[0].limits.time_s, 120);
  for (const char* name : {"selsim_fig4a.yaml", "selsim_fig4b.yaml"}) {
    const auto suite = read_suite((folder / name).string());
    ASSERT_TRUE(suite.ok()) << suite.error().message;
    for (const ProblemSource& source : suite->problems) {
      if (std::string(name) == "selsim_fig4a.yaml")
        EXPECT_EQ(source.tabletop.immovable, 3);
      else
        EXPECT_EQ(source.tabletop.movable + source.tabletop.immovable, 12);
    }
  }
}

}  // namespace
}  // namespace mamo
