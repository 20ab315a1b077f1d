// One motion in physics, judged: drive the arm along a joint path, stop at the first violation, let settle.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/model/interaction.hpp"
#include "mamo/model/motion.hpp"
#include "mamo/physics/world.hpp"

namespace mamo {

/// Outcome of a motion: a pure function of (scene, present, state, motion), bit for bit, whichever worker ran it.
struct Evaluation {
  bool valid = false;
  bool cancelled = false;                 // stopped from outside: nothing else is meaningful
  std::optional<Violation> violation;     // the first one
  WorldState state;                       // at the end, quantised; objects not present keep their poses
  double settle_s = 0;                    // waited after the last point until all rested: whole steps
  std::vector<Interaction> interactions;  // sorted by (first time, a, b): robot-object and object-object
  bool second_order = false;              // some interaction is between two objects
  int steps = 0;
  ObjectSet took_part;                     // World::took_part(): on these and the motion alone the outcome depends
  std::vector<Eigen::AlignedBox3d> swept;  // World::swept(); what is asleep clear of these did not take part
};

struct EvaluationRequest {
  const ObjectSet* present = nullptr;  // simulated objects (fixtures always are)
  const WorldState* from = nullptr;
  const TimedPath* motion = nullptr;
  ObjectId untouchable = kNoObject;  // the task's target: touching it is a violation whatever its constraints
  ObjectId grasped = kNoObject;      // the arm passes through it: a gripper closing on it
  ObjectId held = kNoObject;         // attached to held_link from the start on
  LinkId held_link;
  /// The wait at the end lasts until every object is asleep, and the state says where they sleep: what follows in a
  /// continuous replay is then, bit for bit, what an evaluation from that state gives. Longer than settle_time: not at
  /// rest.
  bool until_asleep = false;
  StopSource* stop = nullptr;                 // may be null
  const std::atomic<bool>* cancel = nullptr;  // may be null: speculation that can no longer matter
};

/// One per worker: owns a World and the constraint watch.
///
/// The motion takes round(duration / step) steps, the arm at motion.at(k * step) after step k, and ends at its
/// last point; then the arm stays until every object has rested for kRestTime, at most settle_time. The first step
/// that violates a constraint ends the evaluation: of several violations in one step the first by kind, then by
/// ids is reported. Tilt, displacement and support refer to the scene's start, whatever state the motion starts
/// from; pairs of bodies that touch there (kTouchDistance) may touch for ever. Objects that neither the robot nor
/// something it moved has touched end exactly where they began (unless they moved by more than kTouchDistance).
class Evaluator {
 public:
  Evaluator(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene);
  ~Evaluator();
  Evaluation evaluate(const EvaluationRequest& request);
  std::int64_t simulations() const;  // run so far
  World::Ball ball(ObjectId id) const { return world().ball(id); }
  double simulation_s() const;  // thread CPU time spent in them

 private:
  const World& world() const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bodies closer than this at the scene's start touch there (m).
inline constexpr double kTouchDistance = 0.001;
/// An object moves when it is further than this from where it began (m) or faster than that (m/s).
inline constexpr double kMovedDistance = 1e-4;
inline constexpr double kMovedSpeed = 1e-3;

}  // namespace mamo
