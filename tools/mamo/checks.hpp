// Checks of option values, with messages that say what was expected.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mamo::tool {

/// For CLI::Option::check: returns "" or what is wrong.
using Check = std::function<std::string(const std::string&)>;

/// A whole number in [low, high].
Check whole_number(std::int64_t low, std::int64_t high = INT64_MAX);
/// A finite number > low (or >= low).
Check number_above(double low);
Check number_at_least(double low);
Check one_of(std::vector<std::string> names);
/// NAME=VALUE with a name.
Check assignment(const std::string& pattern);
/// Not empty.
Check file_name();

/// " (did you mean 'x'?)" for the candidate that differs least, or "" when none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);
std::string join(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace mamo::tool
