// The manipulation lattice as a search domain: joint bins times poses of the relevant objects (SelSim, IV-B).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/lattice/edge_evaluator.hpp"
#include "mamo/lattice/goal.hpp"
#include "mamo/lattice/goal_chain.hpp"
#include "mamo/lattice/grid_heuristic.hpp"
#include "mamo/lattice/lattice_options.hpp"
#include "mamo/search/domain.hpp"

namespace mamo {

/// Exact key. The configuration is base(anchor) + bins * resolution; anchor 0 is the start configuration,
/// anchor k the k-th goal configuration (reached by a snap, bins then zero), and with kOwnConfiguration the bins are
/// the joint vector itself in 1e-6 rad or m (reached by an inverse-kinematics snap).
inline constexpr std::int32_t kOwnConfiguration = -1;
struct LatticeState {
  std::int32_t anchor = 0;
  std::vector<std::int32_t> bins;      // one per group joint
  std::vector<QuantisedPose> objects;  // relevant objects in order of id
  friend auto operator<=>(const LatticeState&, const LatticeState&) = default;
};

/// With LatticeOptions::contact_cost every action has two forms: its own number is the form that touches no relevant
/// object (never simulated), the number plus this the form that does, which costs more. Every motion has exactly one
/// of the two, and with fewer relevant objects it is the same or the cheaper one, so that Theorem 5.2 and the bound,
/// on the cost with contacts included, stand. Motions free of contact are thus tried first.
inline constexpr std::int32_t kContactForm = 1 << 30;

/// An edge that tracking or verification refuted: not taken again in this query.
struct BannedEdge {
  LatticeState state;
  std::int32_t action;
  friend auto operator<=>(const BannedEdge&, const BannedEdge&) = default;
};

/// Built once per query, shared by all planning iterations: goal, heuristic, actions. Immutable.
///
/// Actions of a configuration, in this order: long primitives, short primitives (near start or goal), steps of the
/// tip along its own axes at fixed orientation and about them at a fixed point (Jacobian, rounded to bins), steps of
/// several joints towards the nearest goal configurations (rounded to bins), snaps onto the nearest goal
/// configurations, and near the goal a snap onto the inverse-kinematics solution that is found from the configuration
/// itself, and for each goal chain the way onto its nearest configuration and along it to the goal (several legs, each
/// evaluated like an edge of its own). They depend on the configuration, the goal and the seed only (Theorem 5.2).
/// Heuristic of a pose goal: (1 - a) times that of the grid plus a times the least joint motion that turns the tip's
/// orientation to that of the goal, angle / sqrt(n) for n joints (|turn| <= sum |dq_i| <= sqrt(n) |dq|). Both are
/// consistent, and so is their mean; a is orientation_share. Of a joint goal: the larger of grid and joint distance.
///
/// Cost: length in joint space (Euclidean, rad and m alike), in 1/1000, rounded up.
class LatticeModel {
 public:
  LatticeModel(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
               const LatticeOptions& options, ReachGoal goal, std::vector<GoalChain> chains, const TrackedPoint& point,
               const ObjectSet& walls);

  struct Move {
    std::int32_t action;
    std::int32_t anchor;             // of the child
    std::vector<std::int32_t> bins;  // of the child
    search::Cost cost;
  };
  /// Children in joint limits. Scratch is the caller's.
  void moves(const LatticeState& state, std::vector<Move>& out) const;
  /// The child of one action; false if there is none. The inverse of what moves() enumerates.
  bool move(const LatticeState& state, std::int32_t action, Move& out) const;

  /// More goal configurations and ways to them; actions there were keep their numbers. Not while a search runs.
  void add_goals(const std::vector<Eigen::VectorXd>& configurations);
  void add_chains(std::vector<GoalChain> chains);

  /// The configurations that an action visits, its child's last; empty if there is no such action.
  std::vector<Eigen::VectorXd> legs(const LatticeState& state, std::int32_t action) const;

  Eigen::VectorXd configuration(std::int32_t anchor, const std::vector<std::int32_t>& bins) const;
  search::Cost heuristic(const Eigen::VectorXd& q) const;
  const ReachGoal& goal() const { return goal_; }
  const GridHeuristic& grid() const { return grid_; }
  const ForwardKinematics& kinematics() const { return *kinematics_; }
  const LatticeOptions& options() const { return options_; }
  search::Cost cost_per_cell() const { return cost_per_cell_; }

 private:
  bool primitive(const LatticeState& state, int index, Move& out) const;
  bool tip_step(const LatticeState& state, const Eigen::VectorXd& q, int index, Move& out) const;
  bool rounded_step(const LatticeState& state, const Eigen::VectorXd& q, const Eigen::VectorXd& dq, Move& out) const;
  bool extend(const LatticeState& state, const Eigen::VectorXd& q, int goal, Move& out) const;
  bool snap(const Eigen::VectorXd& q, int goal, Move& out) const;
  bool join(const Eigen::VectorXd& q, int chain, int link, Move& out) const;
  std::vector<int> nearest_chains(const Eigen::VectorXd& q, int count) const;
  int nearest_link(const GoalChain& chain, const Eigen::VectorXd& q) const;
  bool own_snap(const Eigen::VectorXd& q, Move& out) const;
  std::vector<int> nearest_goals(const Eigen::VectorXd& q, int count) const;
  struct Nearness {
    double to_start, to_goal;  // m, of the tracked point; infinite where the grid knows no way
  };
  Nearness nearness(const Eigen::VectorXd& q) const;
  search::Cost cost_of(const Eigen::VectorXd& dq) const;

  const Problem& problem_;
  std::shared_ptr<const ForwardKinematics> kinematics_;
  LatticeOptions options_;
  ReachGoal goal_;
  std::vector<GoalChain> chains_;
  TrackedPoint point_;
  GridHeuristic grid_;
  Eigen::VectorXd resolution_;              // rad or m per bin
  std::vector<std::int32_t> long_, short_;  // bins of a primitive, per joint
  search::Cost shortest_ = 0;               // cost of the cheapest primitive
  search::Cost cost_per_cell_ = 0;
  Eigen::Vector3d p_start_;  // tracked point at the start (m)
};

/// EdgeReport::tag of an edge that was refused, and the name under which it is counted in a result
/// ("simulation_tilt", "collision_robot_touch").
std::int32_t failure_tag(ViolationKind kind, bool simulated);
std::string failure_name(std::int32_t tag);

/// The search domain of one planning iteration: the lattice projected onto the relevant objects (S_sel).
class ManipulationLattice {
 public:
  using State = LatticeState;
  struct Context {
    EdgeEvaluator* evaluator = nullptr;
    std::vector<LatticeModel::Move> moves;
  };

  ManipulationLattice(const Problem& problem, const LatticeModel& model, const RelevantBodies& bodies,
                      const std::set<BannedEdge>& banned, StopSource* stop,
                      std::shared_ptr<OutcomeMemo> memo = nullptr);

  State start() const;
  std::uint64_t hash(const State& s) const;
  std::uint64_t class_hash(const State& s) const;
  bool same_class(const State& a, const State& b) const;
  bool is_goal(const State& s) const;
  search::Cost heuristic(const State& s) const;
  void successors(Context& context, const State& s, std::vector<search::LazyEdge>& out) const;
  search::EdgeOutcome<State> evaluate(Context& context, const State& s, std::int32_t action,
                                      const std::atomic<bool>* cancel) const;
  /// The simulations that the search on one thread would have run for this edge (OutcomeMemo::charged).
  std::int32_t on_commit(const State& s, std::int32_t action, const search::EdgeReport& report) const;

  /// Where all objects are in a state: relevant ones as the state says, the others at their start.
  WorldState world_of(const State& s) const;
  const std::vector<ObjectId>& relevant() const { return ids_; }

 private:
  using PoseClass = std::array<std::int32_t, 9>;
  PoseClass pose_class(std::size_t k, const QuantisedPose& pose) const;
  /// What the collision checker says of an action: free, blocked at or touching from a leg on.
  struct Seen {
    Glance glance = Glance::free;
    std::size_t leg = 0;
    std::int32_t tag = 0;
    std::int64_t checks = 0;
  };
  Seen look(Context& context, const State& s, std::int32_t action, const std::vector<Eigen::VectorXd>& legs) const;
  void simulate(Context& context, const State& s, std::int32_t action, const std::vector<Eigen::VectorXd>& legs,
                std::size_t first, const std::atomic<bool>* cancel, search::EdgeOutcome<State>& outcome,
                WorldState& world) const;
  using Edge = BannedEdge;
  struct Use {
    std::shared_ptr<const SimulatedMotion> motion;
    WorldState from;
  };
  /// What evaluations leave for one another and for on_commit(); contents depend on threads, answers do not.
  struct Notes {
    std::mutex mutex;
    std::map<Edge, Seen> seen;              // of the first form, until the second has been evaluated
    std::map<Edge, std::vector<Use>> uses;  // of physics, until the edge commits
  };

  const Problem& problem_;
  const LatticeModel& model_;
  RelevantBodies bodies_;
  std::vector<ObjectId> ids_;
  std::vector<bool> symmetric_;  // rotation about the object's z axis does not matter
  WorldState start_;
  const std::set<BannedEdge>& banned_;
  std::shared_ptr<OutcomeMemo> memo_;
  StopSource* stop_;
  std::shared_ptr<Notes> notes_ = std::make_shared<Notes>();
};

}  // namespace mamo
