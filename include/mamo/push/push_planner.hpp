// One attempt to push one object along a path: a start, an approach, the push, its simulated verdict (E-M4M,
// "Nonprehensile Push Planner").
//
// Where this differs from the paper: an attempt draws up to `draws` starts and takes the first that passes the cheap
// tests (the paper draws one); the gripper's heading lies between the push's own and the arm's, its pitch and roll are
// drawn too, its height is as low as it can be (pushed high, objects tip); the object's own extent along the push
// counts, not its world-axes box, and so does how far the gripper reaches beyond its tip, so that the tip's way ends
// where the object has arrived; the way is planned before the approach, which costs more; physics comes before a long
// approach search; the arm goes back along the push before it goes home, and all of that is simulated in one piece.
#pragma once

#include <Eigen/Geometry>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/lattice/joint_path.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/physics/evaluation.hpp"

namespace mamo {

struct PushOptions {
  double standoff = 0.05;   // m between the object's boundary and the gripper at the start of a push, typically
  double noise = 0.025;     // m, standard deviation of start and waypoints across the push; added to most standoffs
  double height = 0.03;     // m of the tip above the support; higher where the gripper would touch it
  double pitch_deg = 30;    // of the tip, nose down: most of the common draws; the wide ones go to 90
  double overshoot = 0.01;  // m pushed beyond the path's end
  bool straight = false;    // one segment from first to last point (published code) instead of the shortcut path
  double least_displacement = 0.01;  // m, of some object: less is no push
  int approach_nodes = 1500;         // budget of the approach search
  int draws = 60;                    // starts drawn in one attempt, at most
  int simulations = 2;               // of different draws in one attempt, at most
  /// A push whose end cannot be reached, or is a violation, may end early when it has gone at least this share of the
  /// path; only when the attempt found none that goes all the way. Above 1: never (paper).
  double least_share = 0.4;
};

/// Why an attempt came to nothing, in the order in which the stages come; `none` is success.
enum class PushFailure {
  none,
  start_in_obstacle,   // the sampled start is inside something
  start_unreachable,   // no inverse kinematics there
  start_in_collision,  // the arm at the start hits something
  no_approach,         // no path to the start within the budget
  path_unreachable,    // inverse kinematics ended on the way
  joint_limit,
  path_in_collision,  // the arm hits something untouchable on the way
  misses_object,      // the way does not touch the object
  violation,          // the simulation violated a constraint (Evaluation::violation says which)
  nothing_moved,
  no_retreat,  // no way back to the resting configuration
  stopped,     // cancelled or out of time: says nothing
};
std::string_view to_string(PushFailure failure);

struct PushRequest {
  ObjectId object;
  std::vector<Eigen::Vector2d> path;  // of the object's origin (m), at least two points
  WorldState state;
  int attempt = 0;           // cumulative number: names the random stream
  std::uint64_t stream = 0;  // content hash of the vertex and of (object, goal cell)
};

/// Thread CPU time by stage (s).
struct PushTimes {
  double start = 0, way = 0, approach = 0, simulation = 0, retreat = 0;
};

/// All of it begins and ends at the resting configuration (q_start), so that a vertex is poses of objects only.
/// `push` is simulated in one piece, from rest: there and back again to where it began, then a wait of settle_s.
/// `approach` and `retreat` touch nothing (movables padded), before and after.
struct PushOutcome {
  PushFailure failure = PushFailure::stopped;  // of the draw that came furthest
  std::vector<Eigen::VectorXd> approach;       // from q_start, free of every object
  std::vector<Eigen::VectorXd> push;           // begins where the approach ends; there and back
  std::vector<Eigen::VectorXd> retreat;        // begins where the push ends, back to q_start
  WorldState after;                            // objects after the retreat, quantised
  std::vector<ObjectId> moved;                 // objects whose pose differs from the request's state by more than noise
  std::optional<Violation> violation;          // of failure `violation`
  double settle_s = 0;                         // waited at the end of `push`, before the retreat
  double share = 1;                            // of the path; below 1 the push ends early
  int simulations = 0;
  std::int64_t collision_checks = 0;
  double simulation_s = 0;  // thread CPU time in the simulator
  PushTimes times;
  bool valid() const { return failure == PushFailure::none; }
};

/// One per worker: collision checker and physics world over shared immutable models. Pure: an outcome depends on
/// (problem, options, seed, request) only.
class PushPlanner {
 public:
  /// The problem must outlive the planner.
  PushPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics, const PushOptions& options,
              std::uint64_t seed);
  ~PushPlanner();

  /// `stop` and `cancel` may be null.
  PushOutcome attempt(const PushRequest& request, StopSource* stop, const std::atomic<bool>* cancel);

  /// A stored push, with the objects elsewhere: does its arm motion stay clear of the objects in `others` at `state`,
  /// and do the poses that it gave its own objects (`moved`, at `after`)? (Reuse condition of the data base, both
  /// halves.)
  bool reusable(const PushOutcome& stored, const WorldState& state, const ObjectSet& others);

  CollisionChecker& collision();
  std::int64_t simulations() const;  // run so far, cancelled ones included
  double simulation_s() const;       // thread CPU time spent in them

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mamo
