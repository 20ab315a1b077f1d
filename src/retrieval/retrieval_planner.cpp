#include "mamo/retrieval/retrieval_planner.hpp"

#include <stdexcept>

#include "retrieval/grasp_set.hpp"

namespace mamo {
namespace {

using retrieval::GraspSet;
using retrieval::Legs;
using retrieval::Phase;
using retrieval::WayHome;

constexpr std::uint64_t kHomeKey = 0x686f6d65, kApproachKey = 0x617070;

/// One call: the cheap tests of every candidate with what is known first, then searches.
class Call {
 public:
  Call(const GraspSet& set, CollisionChecker& checker, const WorldState& state, const ObjectSet& obstacles,
       StopSource* stop)
      : set_(set), legs_(set.around, checker, state, obstacles), stop_(stop) {}

  RetrievalOutcome run(int first) {
    const int count = static_cast<int>(set_.candidates.size());
    std::vector<int> blocked;  // grasps that work, with the known way home not free
    for (int c = std::max(first, 0); c < count && !out_.path; ++c) {
      if (stopped()) return std::move(out_);
      if (!grasp_free(c)) continue;
      if (!by_known_way(c)) blocked.push_back(c);
    }
    int searches = 0;
    for (std::size_t k = 0; k < blocked.size() && !out_.path && searches < set_.options.searches; ++k, ++searches) {
      if (stopped()) return std::move(out_);
      by_search(blocked[k]);
    }
    if (!out_.path && stopped()) return std::move(out_);
    out_.exhausted = !out_.path && first <= 0 && blocked.empty();
    return std::move(out_);
  }

 private:
  bool stopped() { return out_.stopped = stop_ && stop_->stopped(); }

  bool fail(const char* cause) {
    ++out_.failures[std::string(cause) + ": " + legs_.hit()];
    return false;
  }

  /// The gripper where it stops, then the legs between.
  bool grasp_free(int c) {
    const GraspCandidate& candidate = set_.candidates[static_cast<std::size_t>(c)];
    if (!legs_.free(Phase::approach, candidate.reach.front())) return fail("pregrasp_in_collision");
    if (!legs_.free(Phase::reach, candidate.reach.back())) return fail("grasp_in_collision");
    legs_.grip(candidate.reach.back());
    if (!legs_.free(Phase::carry, candidate.lift.back())) return fail("lift_in_collision");
    if (!legs_.free(Phase::reach, candidate.reach)) return fail("reach_in_collision");
    if (!legs_.free(Phase::leave, candidate.lift[0], candidate.lift[1])) return fail("lift_in_collision");
    for (std::size_t k = 2; k < candidate.lift.size(); ++k)
      if (!legs_.free(Phase::carry, candidate.lift[k - 1], candidate.lift[k])) return fail("lift_in_collision");
    return true;
  }

  bool by_known_way(int c) {
    const WayHome& way = set_.ways[static_cast<std::size_t>(c)];
    return way.known && legs_.free(Phase::carry, way.path) && take(c, way);
  }

  /// Back along the line as far as it is free, then a search for home or for what is still free of the known way.
  bool by_search(int c) {
    const WayHome& known = set_.ways[static_cast<std::size_t>(c)];
    legs_.grip(set_.candidates[static_cast<std::size_t>(c)].reach.back());
    WayHome way = known;
    way.known = false;
    way.approach.clear();
    way.path.resize(known.line_end + 1);
    way.path.resize(std::max<std::size_t>(legs_.free_points(Phase::carry, way.path), 1));
    way.line_end = way.path.size() - 1;
    if (way.line_end < way.over_pregrasp) way.over_pregrasp = 0;
    std::vector<retrieval::Suffix> others;
    if (known.known) {
      std::size_t from = known.path.size() - 1;
      while (from > known.line_end && legs_.free(Phase::carry, known.path[from - 1], known.path[from])) --from;
      others.push_back({&known, from});
    }
    const RandomStream random(set_.seed, {kHomeKey, static_cast<std::uint64_t>(c)});
    if (!retrieval::find_rest(set_, legs_, way, others, random, {set_.options.max_nodes}, stop_)) {
      ++out_.failures["no_way_home"];
      return false;
    }
    return take(c, way);
  }

  /// Adds the approach to a way home that is free.
  bool take(int c, const WayHome& way) {
    const GraspCandidate& candidate = set_.candidates[static_cast<std::size_t>(c)];
    RetrievalPath path;
    path.grasp = c;
    path.reach = candidate.reach;
    if (!way.approach.empty() && legs_.free(Phase::approach, way.approach))
      path.approach = way.approach;
    else
      path.approach = retrieval::find_approach(set_, legs_, way, candidate.reach.front(),
                                               RandomStream(set_.seed, {kApproachKey, static_cast<std::uint64_t>(c)}),
                                               {set_.options.max_nodes}, stop_);
    if (path.approach.empty()) {
      ++out_.failures["no_approach"];
      return false;
    }
    path.extract = candidate.lift;
    path.extract.insert(path.extract.end(), way.path.begin() + 1, way.path.end());
    out_.path = std::move(path);
    return true;
  }

  const GraspSet& set_;
  Legs legs_;
  StopSource* stop_;
  RetrievalOutcome out_;
};

}  // namespace

RetrievalPlanner::RetrievalPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                                   const RetrievalOptions& options, std::uint64_t seed, Executor& executor,
                                   const std::vector<CollisionChecker*>& checkers) {
  if (!std::holds_alternative<Retrieve>(problem.task)) throw std::invalid_argument("the task is not to retrieve");
  grasps_ = std::make_shared<const GraspSet>(problem, std::move(kinematics), options, seed, executor, checkers);
}

RetrievalPlanner::RetrievalPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                                   const RetrievalOptions& options, std::uint64_t seed, CollisionChecker& checker) {
  if (!std::holds_alternative<Retrieve>(problem.task)) throw std::invalid_argument("the task is not to retrieve");
  Executor alone(1);
  grasps_ = std::make_shared<const GraspSet>(problem, std::move(kinematics), options, seed, alone,
                                             std::vector<CollisionChecker*>{&checker});
}

const std::vector<GraspCandidate>& RetrievalPlanner::candidates() const { return grasps_->candidates; }
const std::map<std::string, std::int64_t>& RetrievalPlanner::rejected() const { return grasps_->rejected; }

RetrievalOutcome RetrievalPlanner::plan(CollisionChecker& checker, const WorldState& state, const ObjectSet& obstacles,
                                        int first, StopSource* stop) const {
  return Call(*grasps_, checker, state, obstacles, stop).run(first);
}

}  // namespace mamo
