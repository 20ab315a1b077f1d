// "unknown key 'masss'; did you mean 'mass'?"
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mamo {

/// Levenshtein distance; names longer than 256 are compared by their beginning.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name with the smallest edit distance (first of equals); empty when `known` is empty.
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& known);

}  // namespace mamo
