// Files that a run is going to write, tested before any work starts.
#pragma once

#include <string>
#include <vector>

#include "mamo/common/result.hpp"

namespace mamo::tool {

/// An error when one of `outputs` (empty names are skipped) cannot be written (kind output), or is one of `inputs`, or
/// is named twice (kind usage).
Status check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace mamo::tool
