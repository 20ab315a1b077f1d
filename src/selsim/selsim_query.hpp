// One query of selective simulation: the state that Algorithm 2 keeps between its planning iterations.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "selsim/selsim_notes.hpp"
#include "selsim/selsim_options.hpp"

#include "mamo/common/executor.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/common/stopwatch.hpp"
#include "mamo/lattice/manipulation_lattice.hpp"
#include "mamo/search/search_result.hpp"
#include "mamo/search/trace.hpp"
#include "mamo/selsim/selsim_planner.hpp"
#include "mamo/selsim/tracker.hpp"

namespace mamo {

/// Invariants of the loop in run(): every iteration that does not return makes `relevant_` or `banned_` grow;
/// what depends on `relevant_` is rebuilt, the rest (goal, heuristic, worlds) is not.
class SelSimQuery {
 public:
  SelSimQuery(const SelSimVariant& variant, const Problem& problem, const PlanOptions& options,
              const PlanContext& context);
  PlanResult run();

 private:
  using Search = search::SearchResult<LatticeState>;
  struct Candidate {
    std::vector<Eigen::VectorXd> path;
    std::vector<int> step_of_leg;  // which step of the search result each piece of the path belongs to
    Track track;
    Verdict verdict;  // of the judge
  };

  void prepare();
  Search search_once();
  /// After a search that used up its round: more goal configurations and chains, from a stream of their own, and twice
  /// the expansions. A greedy search that is lost between objects is better begun anew with more ways to choose from;
  /// as rounds double, little is lost if it was not. Both depend on configuration, task, seed and what stays, so
  /// Theorem 5.2 holds within a round; bounds and proofs are of the last one's lattice. False: limits are reached.
  bool widen();
  /// Of a joint path (milliradians), at most the cost that the search gave to it: each of its edges is rounded up and
  /// pays for contacts besides. So the search's bound holds for it, and for what smoothing leaves of it all the more.
  static std::int64_t length(const std::vector<Eigen::VectorXd>& path);
  Candidate candidate_of(const Search& found) const;
  /// Tracks, smooths and judges a found path. True: the result is complete. False: learn() has been told.
  bool accept(const Search& found);
  bool judged(Candidate& candidate);
  void learn(const std::vector<Interaction>& interactions, const Violation& violation, int step, const Search& found);
  void note_refuted(const Candidate& candidate, int edge, const WorldState& before, const Violation& violation);
  EdgeEvaluator& evaluator() { return *workers_.front(); }
  Plan plan_of(const Track& track) const;
  PlanResult& finish(PlanStatus status, std::string reason);
  PlanResult& no_path(const Search& search);
  PlanResult& out_of_simulations();
  PlanResult& stopped();

  const SelSimVariant variant_;
  const Problem& problem_;
  const PlanOptions& options_;
  const PlanContext& context_;
  SelSimOptions settings_;
  double weight_ = 1;

  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::unique_ptr<Executor> executor_;
  std::vector<std::unique_ptr<EdgeEvaluator>> workers_;  // one per thread; the first also tracks and smooths
  std::shared_ptr<OutcomeMemo> memo_;                    // theirs; null: not asked for
  std::unique_ptr<LatticeModel> model_;
  ObjectSet walls_;  // what stays and may not be touched
  bool chain_budget_used_up_ = false;
  int round_ = 0;
  std::int64_t round_expansions_ = 0;  // of one search, before the lattice is widened
  RelevantBodies everything_;
  ObjectSet relevant_;
  std::set<BannedEdge> banned_;

  search::Trace trace_;  // of the planning iteration that took longest, if a trace is asked for
  Stopwatch watch_;
  PlanResult result_;
  SelSimNotes notes_;  // filled if they are asked for
  HashStream signature_;
  bool merged_ = false;  // some state was dropped whose exact key differed from the one that closed its class
};

}  // namespace mamo
