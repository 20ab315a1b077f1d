// What the planners have in common that come to the grasp with the arm touching what it may, and then fetch the object:
// ways to fetch it when no movable object is there, what simulation says of them, whole plans put before the judge.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mamo/common/hash.hpp"
#include "mamo/common/stopwatch.hpp"
#include "mamo/lattice/edge_evaluator.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"
#include "mamo/selsim/tracker.hpp"

namespace mamo {

struct GraspOptions {
  int ways = 8;
  RetrievalOptions retrieval;

  void add_to(OptionTable& table);
};

/// One query: run() prepares, calls search() and fills in the statistics. All on the caller's thread.
class GraspQuery {
 public:
  virtual ~GraspQuery() = default;
  GraspQuery(const GraspQuery&) = delete;
  PlanResult run();

 protected:
  /// All arguments outlive the query.
  GraspQuery(std::string planner, const Problem& problem, const PlanOptions& options, const PlanContext& context,
             const GraspOptions& settings);

  /// Ends by finish(), stopped() or a plan that submit() accepts.
  virtual void search() = 0;

  /// Retrievals by different grasps, planned as if there were no movable objects. Not empty during search().
  const std::vector<RetrievalPath>& ways() const { return ways_; }

  /// The motion with every object present, as the planners of this family step.
  EdgeResult step(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from);
  /// Can the arm at q, objects at `from`, go to the pre-grasp, close on the object and bring it home?
  bool completes(const Eigen::VectorXd& q, const WorldState& from, const RetrievalPath& way);

  enum class Submitted { accepted, rejected, ended };
  /// `path` leads from q_start to the beginning of `way`, or close. accepted, ended: the query is over.
  Submitted submit(std::vector<Eigen::VectorXd> path, const RetrievalPath& way);

  bool over() const { return over_; }
  bool out_of_simulations();
  void finish(PlanStatus status, std::string reason);
  void stopped();

  const Problem& problem() const { return problem_; }
  /// The same scene for planners that reach: the target is touched by nobody.
  const Problem& reach_problem() const { return reach_; }
  const PlanOptions& options() const { return options_; }
  StopSource& stop() const { return *context_.stop; }
  const ForwardKinematics& kinematics() const { return *kinematics_; }
  CollisionChecker& checker() { return evaluator_->collision(); }
  const RelevantBodies& everything() const { return everything_; }
  PlanResult& result() { return result_; }
  HashStream& signature() { return signature_; }
  void report_progress();

 private:
  struct Leg {
    bool valid = false, stopped = false;
    TimedPath motion;  // wait included
    WorldState after;
    std::optional<Violation> violation;
  };
  Leg reach(const RetrievalPath& way, const WorldState& from);
  Leg extract(const RetrievalPath& way, const WorldState& from);
  Leg simulate(EvaluationRequest request, const std::vector<Eigen::VectorXd>& path, const WorldState& from);
  void prepare();
  void add_segment(SegmentKind kind, const TimedPath& motion);
  Submitted judge();

  const Problem& problem_;
  const PlanOptions& options_;
  const PlanContext& context_;
  const GraspOptions& settings_;
  ObjectId target_;
  Problem reach_;

  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::unique_ptr<EdgeEvaluator> evaluator_;
  std::unique_ptr<Evaluator> physics_;  // for what holds the object
  RelevantBodies everything_;
  std::vector<RetrievalPath> ways_;

  std::int64_t tracked_ = 0;  // simulations of evaluator_ that went over a found path again
  bool over_ = false;
  Stopwatch watch_;
  PlanResult result_;
  HashStream signature_;
};

}  // namespace mamo
