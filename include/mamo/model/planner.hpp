// The interface every planner stands behind, and the judge that planners know only as an interface.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// What a replay of a plan found. Violations in order of time; the replay stops at the first physical one.
struct Verdict {
  bool ok = false;
  bool stopped = false;  // the stop source fired first: no verdict
  struct Finding {
    int segment = 0;
    Violation violation;
    std::string text;  // one line for a person
  };
  std::vector<Finding> findings;
  /// Pairs seen up to the violation, for planners that learn from a rejection; times from the plan's start.
  std::vector<Interaction> interactions;
  /// Where the replay saw every object that is no fixture at each segment's end (as far as it came; the last one after
  /// settling). A planner whose prediction is off may take these: the replay repeats bit for bit.
  std::vector<std::map<ObjectId, Eigen::Isometry3d>> objects_after;
};

/// Replays a plan in a fresh world with every object. Implemented by `verify`, passed in by the mains.
class PlanJudge {
 public:
  virtual ~PlanJudge() = default;
  virtual Verdict judge(const Problem& problem, const Plan& plan, StopSource& stop) const = 0;
};

/// Shared by all planners. Planner-specific options go by documented name in `set` ("goal_configurations").
struct PlanOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  double weight = 0;  // suboptimality factor; 0: the planner's default
  std::int64_t max_simulations = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_expansions = std::numeric_limits<std::int64_t>::max();
  std::string schedule = "runahead";
  int batch = 0;  // 0: the schedule's default
  bool smooth = true;
  std::string trace_path;
  bool explain = false;  // fill PlanResult::notes
  std::map<std::string, std::string> set;
};

/// For a progress line.
struct Progress {
  double elapsed_s = 0;
  std::int64_t expansions = 0, simulations = 0;
  double best_bound = 0;  // smallest f of OPEN, milliradians
  int relevant_objects = 0, planning_iterations = 0;
};

/// What a planner may use besides its input. All outlive the call.
struct PlanContext {
  StopSource* stop = nullptr;                        // never null
  const PlanJudge* judge = nullptr;                  // null: found plans are returned unverified
  std::function<void(const Progress&)> on_progress;  // called on the caller's thread, may be empty
};

/// Reusable: a second query on the same object starts warm. Not thread-safe; use one per thread.
class Planner {
 public:
  virtual ~Planner() = default;
  virtual std::string name() const = 0;
  /// False when the planner cannot do what the problem asks (exit 64).
  virtual bool can_solve(const Task& task) const = 0;
  /// Never throws for a problem that io accepted; throws std::invalid_argument for unknown options.
  virtual PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) = 0;
};

}  // namespace mamo
