// Is this motion valid here, and where do the objects end up? Collision first, physics only when it cannot
// tell (SelSim, Algorithm 1; ARCHITECTURE, decision 4).
#pragma once

#include <Eigen/Core>

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/lattice/outcome_memo.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/physics/evaluation.hpp"

namespace mamo {

/// Which bodies count, fixed for one planning iteration (C_R of the paper, fixtures included).
struct RelevantBodies {
  ObjectSet relevant;   // simulated when a contact asks for it; no fixtures
  ObjectSet forbidden;  // fixtures and relevant bodies that the robot may not touch
  ObjectSet watched;    // relevant bodies that the robot may touch
};
/// Splits `relevant` by what the robot may touch. The task's target is always forbidden.
RelevantBodies make_relevant_bodies(const Problem& problem, const ObjectSet& relevant);
/// The object that the pose of a reach task is for, or kNoObject.
ObjectId target_of(const Task& task);

/// Outcome of one motion.
struct EdgeResult {
  bool valid = false;
  bool simulated = false;  // physics was asked, or what it said before was remembered
  bool cancelled = false;
  WorldState state;                       // where the objects are afterwards
  TimedPath motion;                       // filled when simulated or when the caller asked for it
  double settle_s = 0;                    // wait after the motion
  std::vector<Interaction> interactions;  // empty unless simulated
  bool second_order = false;
  std::optional<Violation> violation;                       // why invalid; kind self_collision names no object
  std::shared_ptr<const SimulatedMotion> motion_simulated;  // if simulated and a memo is used
};

/// What the collision checker alone says of a motion.
enum class Glance { free, blocked, touching };  // touching: physics must tell

/// One per worker: collision managers and a physics world over shared immutable models. Pure: the outcome of
/// evaluate() depends on its arguments only.
class EdgeEvaluator {
 public:
  EdgeEvaluator(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                const CollisionOptions& collision);
  /// From now on outcomes are looked up and kept there. May be null.
  void use_memo(std::shared_ptr<OutcomeMemo> memo) { memo_ = std::move(memo); }
  std::shared_ptr<OutcomeMemo> make_memo() const;

  /// The straight joint motion from q0 to q1 with the objects at `from`. `stop` and `cancel` may be null.
  EdgeResult evaluate(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const RelevantBodies& bodies,
                      const WorldState& from, StopSource* stop, const std::atomic<bool>* cancel);

  /// The first half of evaluate(). `violation` is written when blocked.
  Glance glance(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const RelevantBodies& bodies,
                const WorldState& from, std::optional<Violation>& violation);
  /// Does this outcome of evaluate(), taken into use now, count as a simulation? (OutcomeMemo::charged)
  bool counts(const EdgeResult& result, const RelevantBodies& bodies, const WorldState& from) const;

  CollisionChecker& collision() { return collision_; }
  std::int64_t collision_checks() const { return collision_.checks(); }
  std::int64_t simulations() const { return physics_.simulations(); }
  double simulation_s() const { return physics_.simulation_s(); }

 private:
  const Problem& problem_;
  ObjectId target_;
  CollisionChecker collision_;
  Evaluator physics_;
  CollisionReport report_;
  std::shared_ptr<OutcomeMemo> memo_;
};

}  // namespace mamo
