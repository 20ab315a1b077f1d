#include "checks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "console.hpp"

#include "mamo/common/nearest_name.hpp"

namespace mamo::tool {
namespace {

std::string but_got(const std::string& expected, const std::string& text) {
  return "expected " + expected + ", got '" + text + "'";
}

bool parse(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

Check whole_number(std::int64_t low, std::int64_t high) {
  const std::string expected =
      high == INT64_MAX
          ? format("a whole number of at least %lld", static_cast<long long>(low))
          : format("a whole number from %lld to %lld", static_cast<long long>(low), static_cast<long long>(high));
  return [=](const std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool good = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
    return good ? "" : but_got(expected, text);
  };
}

Check number_above(double low) {
  return [=](const std::string& text) -> std::string {
    double value = 0;
    return parse(text, value) && value > low ? "" : but_got(format("a number above %g", low), text);
  };
}

Check number_at_least(double low) {
  return [=](const std::string& text) -> std::string {
    double value = 0;
    return parse(text, value) && value >= low ? "" : but_got(format("a number of at least %g", low), text);
  };
}

Check one_of(std::vector<std::string> names) {
  return [names = std::move(names)](const std::string& text) -> std::string {
    if (std::find(names.begin(), names.end(), text) != names.end()) return "";
    return "there is no '" + text + "'" + did_you_mean(text, names) + "; there are: " + join(names);
  };
}

Check assignment(const std::string& pattern) {
  return [=](const std::string& text) -> std::string {
    const std::size_t equals = text.find('=');
    return equals != std::string::npos && equals > 0 ? "" : but_got(pattern, text);
  };
}

Check file_name() {
  return [](const std::string& text) -> std::string { return text.empty() ? "expected a file name, got ''" : ""; };
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t d = edit_distance(word, candidate); d < least) least = d, best = &candidate;
  return best ? " (did you mean '" + *best + "'?)" : "";
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : separator) + word;
  return out;
}

}  // namespace mamo::tool
