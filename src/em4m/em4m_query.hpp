// One query of E-M4M: the best-first search over rearrangements (Algorithm 1 of the paper).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "em4m/em4m_notes.hpp"
#include "em4m/em4m_options.hpp"
#include "em4m/push_database.hpp"
#include "em4m/vertex.hpp"

#include "mamo/em4m/em4m_planner.hpp"

namespace mamo {

/// The serial meaning: vertices in order of priority, objects by id, attempts by number, each object's first valid
/// attempt is its push. What is dear and pure (an attempt, a retrieval against all objects) is a job that
/// idle workers may compute ahead; everything else happens on the caller's thread at commit.
///
/// The arm rests at the start configuration between pushes, so a vertex is poses of objects only. The price is a longer
/// plan to execute: every push goes out and comes back.
class Em4mQuery : public RearrangementQuery {
 public:
  Em4mQuery(const Em4mVariant& variant, const Problem& problem, const PlanOptions& options, const PlanContext& context,
            const Em4mOptions& settings);

 private:
  struct Attempt {
    std::shared_ptr<PushOutcome> outcome;  // shared with the job, which may outlive the expansion
    JobBoard::Handle job;
  };
  using Attempts = std::vector<Attempt>;

  void search() override;
  void search_rearrangements();
  std::string what_is_in_the_way() const override;

  // Vertices.
  Vertex& add_vertex(int region, Vertex* parent, PushStep step, WorldState state);
  Priority priority_of(const Vertex& vertex, const RegionFeatures& features) const;
  void open(Vertex& vertex);
  void reorder(Vertex& vertex);
  void close(Vertex& vertex);
  void add_successor(Vertex& vertex, const ObjectPath& path, std::shared_ptr<const PushOutcome> push, WorldState after);
  static bool refuted(const Vertex& vertex);
  static std::vector<Vertex*> chain_of(Vertex& vertex);

  // Done(v) of Algorithm 1.
  void post_retrieval(Vertex& vertex);
  bool done(Vertex& vertex);
  void learn(const Verdict& verdict, Vertex& vertex);

  // ExpandState(v) of Algorithm 1.
  void expand(Vertex& vertex);
  static bool grow_invalid_goals(Vertex& vertex);
  ObjectPathsResult paths_of(const Vertex& vertex);
  bool push_again(Vertex& vertex, const ObjectPath& path);
  std::vector<Attempts> post_attempts(const Vertex& vertex, const std::vector<const ObjectPath*>& paths);
  bool push_object(Vertex& vertex, const ObjectPath& path, Attempts& attempts);

  const Em4mVariant variant_;
  const Em4mOptions& settings_;
  std::vector<VoxelVolume> regions_;  // V(gamma) of the paper, least obstructed first
  std::deque<Vertex> vertices_;
  std::set<Vertex*, MorePromising> open_;
  std::map<std::pair<int, RearrangementClass>, int> fewest_pushes_;  // by region
  PushDatabase database_;
  const Vertex* best_ = nullptr;
  Em4mNotes notes_;
};

}  // namespace mamo
