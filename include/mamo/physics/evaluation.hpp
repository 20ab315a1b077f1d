// One motion in physics, judged: drive the arm along a joint path, stop at the first violation, let settle.
#pragma once

#include <functional>
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
  bool cancelled = false;              // stopped from outside: nothing else is meaningful
  std::optional<Violation> violation;  // the first one
  WorldState state;                    // at the end, quantised; objects not present keep their poses
  double settle_s = 0;                 // waited after the last point until all rested (whole steps)
  std::vector<Interaction> interactions;  // sorted by (first time, a, b): robot-object and object-object
  bool second_order = false;           // some interaction is between two objects
  int steps = 0;
};

struct EvaluationRequest {
  const ObjectSet* present = nullptr;  // simulated objects (fixtures always are)
  const WorldState* from = nullptr;
  const TimedPath* motion = nullptr;
  ObjectId untouchable = kNoObject;    // the task's target: touching it is a violation whatever its constraints
  ObjectId held = kNoObject;           // attached to held_link from the start on
  LinkId held_link;
  StopSource* stop = nullptr;          // may be null
  const std::atomic<bool>* cancel = nullptr;  // may be null: speculation that can no longer matter
};

/// One per worker: owns a World and the constraint watch.
class Evaluator {
 public:
  Evaluator(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene);
  ~Evaluator();
  Evaluation evaluate(const EvaluationRequest& request);
  std::int64_t simulations() const;  // run so far
  double simulation_s() const;       // thread CPU time spent in them

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mamo
