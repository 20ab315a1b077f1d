// "unknown key 'masss'; did you mean 'mass'?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mamo::io {

/// The known name with the smallest edit distance (first of equals); empty when `known` is empty.
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& known);

}  // namespace mamo::io
