// One query of E-M4M: the best-first search over rearrangements (Algorithm 1 of the paper).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "em4m/em4m_options.hpp"
#include "em4m/push_database.hpp"
#include "em4m/vertex.hpp"

#include "mamo/common/executor.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/common/job_board.hpp"
#include "mamo/common/stopwatch.hpp"
#include "mamo/em4m/em4m_planner.hpp"

namespace mamo {

/// The serial meaning: vertices in order of priority, objects by id, attempts by number, each object's first valid
/// attempt is its push. What is dear and pure (an attempt, a retrieval against all objects) is a job that
/// idle workers may compute ahead; everything else happens on the caller's thread at commit.
///
/// The arm rests at the start configuration between pushes, so a vertex is poses of objects only. The price is a longer
/// plan to execute: every push goes out and comes back.
class Em4mQuery {
 public:
  Em4mQuery(const Em4mVariant& variant, const Problem& problem, const PlanOptions& options, const PlanContext& context);
  PlanResult run();

 private:
  struct Attempt {
    std::shared_ptr<PushOutcome> outcome;  // shared with the job, which may outlive the expansion
    JobBoard::Handle job;
  };

  void prepare();
  void search();
  bool choose_regions();

  // Vertices.
  Vertex& add_vertex(int region, Vertex* parent, PushStep step, WorldState state);
  void reorder(Vertex& vertex);
  void open(Vertex& vertex);
  void add_successor(Vertex& vertex, const ObjectPath& path, std::shared_ptr<const PushOutcome> push, WorldState after);
  void close(Vertex& vertex);
  bool refuted(const Vertex& vertex) const;

  // Done(v) of Algorithm 1.
  void post_retrieval(Vertex& vertex, int urgency);
  bool done(Vertex& vertex);
  static std::vector<Vertex*> chain_of(Vertex& vertex);
  void learn(const Verdict& verdict, Vertex& vertex);

  // ExpandState(v) of Algorithm 1.
  void expand(Vertex& vertex);
  bool grow_invalid_goals(Vertex& vertex);
  std::vector<std::vector<Attempt>> post_attempts(const Vertex& vertex, const std::vector<ObjectPath>& paths);
  bool push_object(Vertex& vertex, const ObjectPath& path, std::vector<Attempt>& attempts);
  bool counted(const ObjectPath& path, const PushOutcome& outcome);

  // How it ended.
  bool over() const { return ended_; }
  void finish(PlanStatus status, std::string reason);
  void stopped();
  std::string what_is_in_the_way() const;
  void count_failures(const std::map<std::string, std::int64_t>& failures, const std::string& prefix);

  const Em4mVariant variant_;
  const Problem& problem_;
  const PlanOptions& options_;
  const PlanContext& context_;
  Em4mOptions settings_;
  ObjectId target_;
  std::vector<ObjectId> movables_;  // in order of id, the target excluded
  ObjectSet all_movables_;

  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::unique_ptr<Executor> executor_;
  std::vector<std::unique_ptr<PushPlanner>> workers_;  // one per thread
  std::unique_ptr<RetrievalPlanner> retrievals_;
  std::unique_ptr<ObjectPathFinder> path_finder_;
  std::vector<VoxelVolume> regions_;  // V(gamma) of the paper, least obstructed first
  JobBoard board_;

  std::deque<Vertex> vertices_;
  std::set<Vertex*, MorePromising> open_;
  std::map<std::pair<int, RearrangementClass>, int> fewest_pushes_;  // by region
  PushDatabase database_;
  std::map<ObjectId, std::map<std::string, int>> causes_;  // of failed attempts, by object
  const Vertex* best_ = nullptr;

  bool ended_ = false;
  Stopwatch watch_;
  PlanResult result_;
  HashStream signature_;
};

}  // namespace mamo
