// After the replay: were the objects predicted where they went, is the task done?
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "verify/timeline.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/planner.hpp"

namespace mamo::verify {

/// objects_after of the plan against the replay; `measured` holds the segments that the replay finished. All objects
/// of the first segment that differs: what follows a difference differs too. `tolerance` in metres; an object may be
/// turned by kTurnTolerance.
std::vector<Verdict::Finding> check_objects(const Problem& problem, const Plan& plan, const Timeline& line,
                                            const std::vector<std::map<ObjectId, Eigen::Isometry3d>>& measured,
                                            double tolerance);

/// What of the task is not done at the plan's last point.
std::optional<Verdict::Finding> check_task(const Problem& problem, const Plan& plan, const Timeline& line,
                                           const ForwardKinematics& kinematics, bool holding);

inline constexpr double kTurnTolerance = 0.5;  // rad: a pushed can spins, and how far is chaotic

}  // namespace mamo::verify
