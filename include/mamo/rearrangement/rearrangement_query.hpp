// What every planner that clears the way by pushes has in common: its parts, one per worker where they are not
// shared; negative goal regions; whole plans put before the judge; how it ends.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mamo/common/executor.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/common/job_board.hpp"
#include "mamo/common/stopwatch.hpp"
#include "mamo/mapf/object_paths.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {

struct RearrangementOptions {
  int attempts = 5;    // pushes tried per object and path
  int regions = 4;     // negative goal regions to choose from
  int rejections = 3;  // retrievals of one rearrangement that verification may reject
  PushOptions push;
  RetrievalOptions retrieval;
  ObjectPathsOptions paths;

  void add_to(OptionTable& table);
};

/// One query. run() prepares, calls search() on the caller's thread with the other workers taking jobs from board(),
/// and fills in the statistics. search() ends by finish(), stopped() or a plan that the judge accepts; what it counts
/// and hashes happens on the caller's thread only.
class RearrangementQuery {
 public:
  virtual ~RearrangementQuery() = default;
  RearrangementQuery(const RearrangementQuery&) = delete;
  PlanResult run();

 protected:
  /// `settings` is kept by reference. All arguments outlive the query.
  RearrangementQuery(std::string planner, const Problem& problem, const PlanOptions& options,
                     const PlanContext& context, const RearrangementOptions& settings);

  virtual void search() = 0;
  /// One line on what keeps the object from being retrieved, for the reason of a failure.
  virtual std::string what_is_in_the_way() const = 0;

  using Step = std::pair<ObjectId, std::shared_ptr<const PushOutcome>>;
  enum class Submitted { accepted, rejected, ended };
  /// Puts the whole plan before the judge. accepted: the query is over, solved. ended: over, stopped.
  Submitted submit(const std::vector<Step>& pushes, const RetrievalPath& retrieval, Verdict& verdict);

  /// Puts `first` and, while the judge rejects and learn() says that it makes sense, the retrievals by later grasps
  /// before the judge, `rejections` at most. rejected: none was accepted, or there was none.
  Submitted try_retrievals(const std::vector<Step>& pushes, const WorldState& state, RetrievalOutcome first,
                           const std::function<bool(const Verdict&)>& learn);

  /// Retrievals without movables by the least obstructed grasps: their volumes, the least obstructed at the start first
  /// (fewer movables, then less of them). Empty: there is none, and the query is over.
  std::vector<VoxelVolume> negative_goal_regions();
  RetrievalOutcome retrieve(const WorldState& state, const ObjectSet& obstacles, int first_grasp, WorkerId worker);

  /// Counts an attempt that is used. False: the query is over (stopped, or one simulation too many).
  bool count(ObjectId object, const PushOutcome& outcome);
  void count_failures(const std::map<std::string, std::int64_t>& failures, const std::string& prefix);
  /// "tilt 3, no_approach 12": the failed attempts at an object so far; empty if there are none.
  std::string failed_attempts(ObjectId object) const;

  bool over() const { return over_; }
  void finish(PlanStatus status, std::string reason);
  void stopped();

  const Problem& problem() const { return problem_; }
  const Scene& scene() const { return problem_.scene; }
  const PlanOptions& options() const { return options_; }
  StopSource& stop() const { return *context_.stop; }
  ObjectId target() const { return target_; }
  const std::vector<ObjectId>& movables() const { return movables_; }  // in order of id, the target excluded
  const ObjectSet& all_movables() const { return all_movables_; }
  PushPlanner& worker(WorkerId w) { return *workers_[w.index()]; }
  PushPlanner& worker() { return *workers_.front(); }
  const ForwardKinematics& kinematics() const { return *kinematics_; }
  const RetrievalPlanner& retrievals() const { return *retrievals_; }
  const ObjectPathFinder& path_finder() const { return *path_finder_; }
  JobBoard& board() { return board_; }
  PlanResult& result() { return result_; }
  const PlanResult& result() const { return result_; }
  HashStream& signature() { return signature_; }
  void report_progress(double best_bound, int rearrangements);

 private:
  void prepare();

  const Problem& problem_;
  const PlanOptions& options_;
  const PlanContext& context_;
  const RearrangementOptions& settings_;
  ObjectId target_;
  std::vector<ObjectId> movables_;
  ObjectSet all_movables_;

  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::unique_ptr<Executor> executor_;
  std::vector<std::unique_ptr<PushPlanner>> workers_;
  std::unique_ptr<RetrievalPlanner> retrievals_;
  std::unique_ptr<ObjectPathFinder> path_finder_;
  JobBoard board_;

  std::map<ObjectId, std::map<std::string, int>> causes_;
  bool over_ = false;
  Stopwatch watch_;
  PlanResult result_;
  HashStream signature_;
};

}  // namespace mamo
