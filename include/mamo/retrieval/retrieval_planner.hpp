// Grasp the object of interest and bring it home against a given set of obstacles (E-M4M, PlanRetrieval of
// Algorithm 1): home -> pre-grasp -> grasp -> lift -> home with the object in the gripper.
//
// The paper has one grasp; we vary its yaw, height and depth about the given pre-grasp (`grasps` = 1: the given one).
// The object is drawn out along the line of its approach and the arm approaches by the same way backwards, so both
// sweep one volume.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/collision/voxel_volume.hpp"
#include "mamo/common/executor.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/lattice/joint_path.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

namespace retrieval {
struct GraspSet;
}

struct RetrievalOptions {
  int grasps = 96;                  // candidate grasp poses around the given pre-grasp: heights, depths, yaws
  int solutions = 4;                // inverse-kinematics solutions per grasp
  double lift = 0.05;               // m, straight up before the object is drawn out
  double max_object_tilt_deg = 20;  // of the held object on the way home; 180: free
  int max_nodes = 3000;             // of each leg's search
  int searches = 8;                 // legs home searched for in one call, after all that are known were tried
  double cell = 0.01;               // m, of the negative goal region
};

/// One grasp that is free of collision with what never moves (fixtures, immovables), with the arm at each stage.
struct GraspCandidate {
  Eigen::Isometry3d X_WT;              // tip when it closes
  Eigen::Isometry3d X_TO;              // object in tip from then on
  std::vector<Eigen::VectorXd> reach;  // straight line of the tip: pre-grasp first, grasp last
  std::vector<Eigen::VectorXd> lift;   // straight line of the tip: grasp first, lifted last
};

/// Joint paths, straight edges between points; each begins where the one before ends.
struct RetrievalPath {
  int grasp = -1;                         // index of the candidate
  std::vector<Eigen::VectorXd> approach;  // from the arm's resting configuration (q_start) to the pre-grasp
  std::vector<Eigen::VectorXd> reach;     // pre-grasp to grasp: the segment at whose end the object is attached
  std::vector<Eigen::VectorXd> extract;   // grasp, lifted, ..., home
};

struct RetrievalOutcome {
  std::optional<RetrievalPath> path;
  bool stopped = false;                          // the stop source fired
  bool exhausted = false;                        // every grasp was tried to the end and no budget cut anything short
  std::map<std::string, std::int64_t> failures;  // cause ("grasp_in_collision: shelf_top", ...) -> count
};

/// Immutable after construction: grasps are drawn once per problem, one instance serves every worker.
class RetrievalPlanner {
 public:
  /// The problem's task must be Retrieve. `executor` and `checkers`, one per worker, are used during construction only;
  /// the result is the same for any number of workers.
  RetrievalPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                   const RetrievalOptions& options, std::uint64_t seed, Executor& executor,
                   const std::vector<CollisionChecker*>& checkers);
  /// On this thread alone.
  RetrievalPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                   const RetrievalOptions& options, std::uint64_t seed, CollisionChecker& checker);

  const std::vector<GraspCandidate>& candidates() const;
  /// Grasp poses that gave no candidate, by cause.
  const std::map<std::string, std::int64_t>& rejected() const;

  /// Objects stand at `state`. Fixtures and immovables always count; of the movables those in `obstacles`. Candidates
  /// are tried in order, from `first` on; the first that works is the outcome. First comes what costs no search: the
  /// gripper at pre-grasp, grasp and lifted, the lines between, and the way home and approach known from construction;
  /// then, for up to `searches` candidates whose grasp is free, a search for another way. Depends on the arguments
  /// only, not on the worker.
  RetrievalOutcome plan(CollisionChecker& checker, const WorldState& state, const ObjectSet& obstacles, int first,
                        StopSource* stop) const;

  /// How much stands in the way of a candidate's retrieval among what never moves.
  struct Obstruction {
    int grasp;    // index of the candidate
    int objects;  // of those asked about, touched (padded) by arm or held object
  };
  /// At most `count` candidates, those that touch the fewest of `objects` first, then in order; for each of them
  /// plan(checker, state, {}, grasp, stop) gives the retrieval that was looked at. What an initial negative goal region
  /// is best made of. About a millisecond a candidate.
  std::vector<Obstruction> least_obstructed(CollisionChecker& checker, const WorldState& state,
                                            const ObjectSet& objects, int count) const;

 private:
  std::shared_ptr<const retrieval::GraspSet> grasps_;  // shared by copies: nobody changes it
};

/// The negative goal region V(gamma): the volume that arm and carried object sweep along the interpolated path, inside
/// `bounds` (the space where objects can stand; outside it nothing can be in the way). Interpolated so finely that no
/// point moves further than half a cell between two poses.
VoxelVolume swept_volume(const Problem& problem, const ForwardKinematics& kinematics, const RetrievalPath& path,
                         const GraspCandidate& grasp, const WorldState& state, const Eigen::AlignedBox3d& bounds,
                         double cell);

/// Marks what the arm alone sweeps along a path, interpolated as finely.
void add_arm_sweep(VoxelVolume& volume, const ForwardKinematics& kinematics, const std::vector<Eigen::VectorXd>& path);

/// Where movable objects can be: the box around every object that may stand there and the supports under them, as high
/// as the tallest. Bounds of negative goal regions and of the grid of the path finding.
Eigen::AlignedBox3d object_space(const Scene& scene);

}  // namespace mamo
