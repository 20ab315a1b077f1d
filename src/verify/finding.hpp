// One line for a person about one violation: segment, object, constraint, value with unit, limit, time.
#pragma once

#include <string>

#include "mamo/model/planner.hpp"

namespace mamo::verify {

/// "mug", "the robot", "the floor", "nothing".
std::string name_of(const Scene& scene, ObjectId id);

/// `detail` says what the numbers do not ("link palm", "the name elbow is unknown"); may be empty.
Verdict::Finding make_finding(const Scene& scene, const Plan& plan, int segment, const Violation& violation,
                              const std::string& detail = {});

}  // namespace mamo::verify
