// One finished run of a suite as one line of JSON ("A bench line", docs/formats.md): writing, reading, and the file
// that they are appended to.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mamo/experiments/suite.hpp"
#include "mamo/model/plan.hpp"

namespace mamo {

/// Where and by what a run was made.
struct RunMachine {
  std::string json;  // the object that goes under "machine"
  std::string commit;
};

/// The result object of a run, with the run's own fields behind it; no line break. `started`: ISO 8601, UTC.
/// difficulty: of a retrieval by our own negative goal region, "" where there is none.
std::string bench_line(const Suite& suite, const BenchRun& run, const PlanResult& result, const Problem& problem,
                       const RunMachine& machine, const std::string& started, bool keep_plan,
                       const std::string& difficulty = "");

/// Name of the file of a run's playback page.
std::string page_file_name(const std::string& run);

/// What reports need of a line.
struct Record {
  std::string suite, run, settings, setting, label, planner, problem, problem_sha256, constraints, status, reason;
  std::string commit, machine, version, processor, started;
  std::string difficulty;         // easy, medium, hard, none; "": not a retrieval, or none found without movables
  std::string difficulty_listed;  // as the list of problem files says
  std::uint64_t seed = 1;
  int movable = 0, immovable = 0, threads = 1, redraws = 0;  // redraws: of goal and scene together
  bool found = false, solved = false;
  double time_s = 0;   // planning and verification, loading not included
  double found_s = 0;  // until the planner held its first path
  double time_limit_s = 0, weight = 0, bound = 0, position_tolerance = 0, angle_tolerance = 0;
  std::int64_t simulations = 0, tracking = 0, expansions = 0;  // simulations: used by the search
  int iterations = 0, relevant = 0;
  double mapf_s = 0, push_planning_s = 0, simulation_s = 0;  // of planners that rearrange
  std::int64_t push_attempts = 0;
  int pushes = 0;  // in the plan
};

/// Errors name the place (`file:line`).
Result<Record> parse_record(const std::string& line, const std::string& place);
/// All lines of a results file. A torn last line (no line break, as a kill leaves it) is passed over.
Result<std::vector<Record>> read_records(const std::string& path);

/// A results file open for appending; one process at a time (a lock on the file). Not thread-safe.
class RecordFile {
 public:
  RecordFile() = default;
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;

  /// Without `resume` a file that holds anything is an error (usage). With it, a torn last line is cut off and what
  /// the others ran is known to done().
  Status open(const std::string& path, bool resume);
  /// Is the run in the file? An error when it is there with other settings, i.e. of another version of the suite.
  Result<bool> done(const BenchRun& run) const;
  /// Commits of the lines already there.
  const std::set<std::string>& commits() const { return commits_; }
  /// On the disk when it returns.
  Status append(const std::string& line);

 private:
  int descriptor_ = -1;
  std::string path_;
  std::set<std::pair<std::string, std::string>> done_;  // run, settings
  std::set<std::string> ids_, commits_;
};

}  // namespace mamo
