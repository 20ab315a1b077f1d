// Problems that a generator makes, written as files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console.hpp"

#include "mamo/common/result.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::tool {

/// Writes problems 0 .. count-1 into a folder, made if need be, and says how many. Files of others are left alone with
/// a warning. Stops early when asked to.
Result<std::vector<Problem>> write_problems(const std::string& folder, int count,
                                            const std::function<Result<Problem>(int)>& make, StopSource& stop,
                                            Console& console);

}  // namespace mamo::tool
