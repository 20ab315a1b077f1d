// The continuous replay: a fresh world with every object, driven from the plan's first point to its last and on until
// everything rests. Nothing is restored, teleported or quantised in between.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "verify/arm_check.hpp"
#include "verify/timeline.hpp"

#include "mamo/common/stop.hpp"
#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/planner.hpp"
#include "mamo/model/recording.hpp"

namespace mamo::verify {

struct ReplayOutcome {
  bool stopped = false;
  std::optional<Violation> violation;     // the first one; time from the plan's start
  std::string detail;                     // what its numbers do not say
  int segment = 0;                        // where the violation happened
  std::vector<Interaction> interactions;  // up to the violation, sorted by (first time, a, b)
  /// Poses at each segment's end as far as the replay came; after settling for the last one.
  std::vector<std::map<ObjectId, Eigen::Isometry3d>> objects_after;
  bool holding = false;  // the retrieved object is attached at the end
};

/// until_s: stop there (an arm hit has been found); infinity to go to the end. `arm` is told what is held.
/// recording: may be null.
ReplayOutcome replay(const Problem& problem, const Plan& plan, const Timeline& line,
                     std::shared_ptr<const ForwardKinematics> kinematics, ArmCheck& arm, double until_s,
                     StopSource& stop, Recording* recording = nullptr);

}  // namespace mamo::verify
