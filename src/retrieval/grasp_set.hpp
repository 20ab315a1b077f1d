// What is known of an object's retrieval before anything movable is looked at: grasps and ways home among fixtures and
// immovables. Made once per problem.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "retrieval/legs.hpp"

#include "mamo/common/executor.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo::retrieval {

/// The way home of a candidate: lifted first, back along the line of the approach as far as that goes, then a searched
/// path. Walked backwards and empty-handed from home to `over_pregrasp` it is an approach.
struct WayHome {
  std::vector<Eigen::VectorXd> path;
  std::size_t over_pregrasp = 0;          // index: above the pre-grasp pose; 0 where the line does not come so far
  std::size_t line_end = 0;               // index: the last point of the straight line
  bool known = false;                     // the path ends at home, else at line_end
  std::vector<Eigen::VectorXd> approach;  // from q_start to the pre-grasp; empty: none is known
};

struct GraspSet {
  GraspSet(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
           const RetrievalOptions& options_in, std::uint64_t seed_in, Executor& executor,
           const std::vector<CollisionChecker*>& checkers);

  Surroundings around;
  RetrievalOptions options;
  std::uint64_t seed;
  std::vector<Eigen::VectorXd> from_start;  // from q_start to home
  std::vector<GraspCandidate> candidates;
  std::vector<WayHome> ways;                     // one per candidate
  std::map<std::string, std::int64_t> rejected;  // grasp poses and solutions that gave no candidate, by cause
};

/// Completes a way that ends somewhere, by a search for home or for a point of `others` from which home is known to be
/// free (an index into each: the first such point). Held objects only. False if the budget is used up.
struct Suffix {
  const WayHome* way;
  std::size_t from;
};
bool find_rest(const GraspSet& grasps, Legs& legs, WayHome& way, const std::vector<Suffix>& others, RandomStream random,
               const JointPathOptions& options, StopSource* stop);

/// An approach to a candidate's pre-grasp: the way home backwards where that is free, else a search. Empty if neither.
std::vector<Eigen::VectorXd> find_approach(const GraspSet& grasps, Legs& legs, const WayHome& way,
                                           const Eigen::VectorXd& pregrasp, RandomStream random,
                                           const JointPathOptions& options, StopSource* stop);

}  // namespace mamo::retrieval
