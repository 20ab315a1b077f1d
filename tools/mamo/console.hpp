// What reaches the user: the result on standard output, everything else on standard error.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "mamo/common/result.hpp"

namespace mamo::tool {

/// Settings of --quiet, -v and --no-color, and the only place of the tool that writes to standard error.
class Console {
 public:
  bool quiet = false;
  int verbosity = 0;
  bool no_color = false;

  /// One line on standard error: a failure (always shown), a warning (unless quiet), a note (with -v).
  void error(std::string_view text);
  void warn(std::string_view text);
  void note(std::string_view text);
  void warn_all(const std::vector<std::string>& lines);

  /// A line on standard error that the next one overwrites; nothing unless standard error is a terminal.
  void progress(std::string_view text);
  void end_progress();
  bool shows_progress() const;

  /// `text` in bold green (good) or bold red where standard output is a terminal that wants colour.
  std::string coloured(std::string_view text, bool good) const;

 private:
  void line(std::string_view text);
  bool progress_shown_ = false;
};

/// Writes an error and returns its exit code.
int fail(Console& console, const Error& error);

/// Line breaks become "; ", control characters become '?': messages quote file contents.
std::string one_line(std::string_view text);

/// printf into a std::string.
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace mamo::tool
