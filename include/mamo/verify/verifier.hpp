// An independent judge of plans: one continuous replay with every object in a fresh world, its own reading
// of the constraints, its own dense checks of the arm. Shares no evaluation code with the planners.
#pragma once

#include "mamo/model/planner.hpp"
#include "mamo/model/recording.hpp"

namespace mamo {

struct VerifyOptions {
  double arm_step = 0.004;           // m: no collision point moves further between two arm checks
  double object_tolerance = 0.02;    // m: objects_after against the replay (contact is chaotic; planning quantises)
};

/// Checks, in this order: the plan is well formed, starts at the problem's start, is continuous, keeps joint
/// and velocity limits; the arm hits neither itself nor what it may not touch; the replay violates no
/// constraint and ends at rest; the task is done.
class Verifier final : public PlanJudge {
 public:
  explicit Verifier(const VerifyOptions& options = {}) : options_(options) {}
  Verdict judge(const Problem& problem, const Plan& plan, StopSource& stop) const override;
  /// The same verdict; the replay, as far as it came, goes into `recording` (empty when there was none).
  Verdict judge(const Problem& problem, const Plan& plan, StopSource& stop, Recording& recording) const;

 private:
  Verdict run(const Problem& problem, const Plan& plan, StopSource& stop, Recording* recording) const;
  VerifyOptions options_;
};

}  // namespace mamo
