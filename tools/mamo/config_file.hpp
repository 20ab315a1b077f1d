// --config FILE.yaml: one flat mapping of option names to values.
#pragma once

#include <string>
#include <vector>

#include "mamo/common/result.hpp"

namespace mamo::tool {

struct ConfigEntry {
  std::string key, value;
  std::string place;  // file:line:column of the value
};

/// Entries in file order. Nested values, anchors, aliases and repeated keys are errors with their place.
Result<std::vector<ConfigEntry>> read_config(const std::string& path);

}  // namespace mamo::tool
