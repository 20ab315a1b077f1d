// Published shelf scenes with the shipped PR2, read in place where they are there.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/retrieve_problem.hpp"
#include "support/shared_data.hpp"
#include "support/verdicts.hpp"

#include "mamo/io/load.hpp"

namespace mamo {
namespace {

using namespace fixtures;

/// Every `stride`-th scene for which a retrieval was published and that has something in the way.
std::vector<std::string> scenes(const std::string& folder, int stride) {
  std::ifstream index(folder + "/index.csv");
  std::string line;
  std::getline(index, line);
  std::vector<std::string> out;
  for (int row = 0; std::getline(index, line);) {
    std::vector<std::string> f;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    if (f.size() < 10 || f[7] != "1" || f[9] == "None") continue;
    if (row++ % stride == 0) out.push_back(folder + "/" + f[1] + "/plan_" + f[0] + "_SCENE.txt");
  }
  return out;
}

TEST(ShelfScenes, AreRetrievedAmongFixturesAndImmovablesAndTheReplayAgrees) {
  MAMO_SHARED_OR_SKIP(folder, "em4m_scenes");
  const std::vector<std::string> files = scenes(folder, 9);
  ASSERT_GE(files.size(), 8u);
  int at_once = 0;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    Result<Problem> problem = io::load_problem(file);
    ASSERT_TRUE(problem) << problem.error().message;
    RetrievalSetup setup(*problem);
    const RetrievalOutcome outcome = setup.plan(setup.nothing);
    ASSERT_TRUE(outcome.path) << testing::PrintToString(setup.planner.rejected());
    const Problem bare = without_movables(setup.problem);
    EXPECT_TRUE(holds(judge(bare, plan_of(bare, *outcome.path))));
    // With the movable objects there: whatever is found holds too.
    const RetrievalOutcome among = setup.plan(setup.movables);
    if (!among.path) continue;
    ++at_once;
    EXPECT_TRUE(holds(judge(setup.problem, plan_of(setup.problem, *among.path))));
  }
  EXPECT_GT(at_once, 0) << "no other grasp ever helps";
}

}  // namespace
}  // namespace mamo
