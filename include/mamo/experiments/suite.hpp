// Suites of experiments: which problems, which planners, which limits (format mamo-suite/1, docs/formats.md), and the
// runs they stand for.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/experiments/problem_source.hpp"

namespace mamo {

/// Of one run. Infinity and the largest integer mean none.
struct RunLimits {
  double time_s = 120;
  std::int64_t max_simulations = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_expansions = std::numeric_limits<std::int64_t>::max();
};

struct PlannerEntry {
  std::string name;   // of the registry
  std::string label;  // in tables; the name unless the suite says otherwise
  std::map<std::string, std::string> set;
  double weight = 0;  // 0: the planner's own
  int threads = 0;    // 0: what the command line says
  RunLimits limits;   // the suite's unless the entry has its own
  int count = 0;      // only the first problems of each source; 0: all
};

struct Suite {
  std::string name;  // the file's, without folder and extension
  std::vector<ProblemSource> problems;
  std::vector<PlannerEntry> planners;
  std::vector<std::uint64_t> seeds{1};
};

/// Globs are looked up from the suite's folder. Unknown keys, planners and options of planners, a glob that matches
/// nothing, two planners of one label: errors with their place.
Result<Suite> read_suite(const std::string& path);

/// One problem, one planner, one seed.
struct BenchRun {
  int index = 0;         // of its problem in the suite: runs of one problem share it
  std::string id;        // names it in results: "suite/setting/problem/label/seed"
  std::string settings;  // 16 digits: a hash of everything that decides its result but the program
  std::size_t source = 0, planner = 0;
  int problem = 0;  // of the source
  std::uint64_t seed = 1;
};

/// Every run of a suite, all planners on a problem before the next problem.
std::vector<BenchRun> runs_of(const Suite& suite);

Result<Problem> problem_of(const Suite& suite, const BenchRun& run);

}  // namespace mamo
