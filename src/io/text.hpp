// Small pieces of text that every reader and writer of io needs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mamo/common/result.hpp"

namespace mamo::io {

/// The shortest decimal that reads back as the same double; always with a '.', so that YAML 1.1 readers take
/// "1.0e-05" for a number. ".inf", "-.inf", ".nan" for the rest.
std::string yaml_number(double value);
/// As above without the forced '.'; "inf", "-inf", "nan" for the rest.
std::string shortest_number(double value);
/// "[1.0, 2.0]".
template <class Range>
std::string yaml_list(const Range& values) {
  std::string text = "[";
  for (double v : values) text += (text.size() > 1 ? ", " : "") + yaml_number(v);
  return text + "]";
}
/// As a YAML scalar: plain where that is safe, else double-quoted.
std::string yaml_string(std::string_view text);

/// In single quotes, control characters shown as \xNN, cut after 60 characters: fit for a one-line message.
std::string in_quotes(std::string_view text);
/// Control characters replaced, for whole messages made by other libraries.
std::string one_line(std::string_view text);

/// A number, the whole text being it. ".inf", "inf", ".nan", "nan" and signs are understood: check for finite.
std::optional<double> parse_number(std::string_view text);

/// `file:line:column: message` (1-based; line 0: no place).
Error error_at(const std::string& file, int line, int column, const std::string& message);

}  // namespace mamo::io
