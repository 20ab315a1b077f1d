// Where the problems of a suite come from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/experiments/refrigerator.hpp"
#include "mamo/experiments/shelf.hpp"
#include "mamo/experiments/tabletop.hpp"

namespace mamo {

/// Generated problems 0 .. count-1 of a setting, or problem files.
struct ProblemSource {
  enum class Kind { files, tabletop, shelf, refrigerator };
  Kind kind = Kind::files;
  TabletopSpec tabletop;  // the one of the kind counts; its index is that of a run
  ShelfSpec shelf;
  RefrigeratorSpec refrigerator;
  int count = 0;                    // of generated problems
  std::string glob;                 // of files, or "@" and the file that lists them
  std::vector<std::string> files;   // what it stands for
  std::vector<std::string> listed;  // of files from a list: the class that it gives each ("easy"), or ""

  bool generated() const { return kind != Kind::files; }
  int size() const { return generated() ? count : static_cast<int>(files.size()); }
  std::uint64_t seed() const;
  /// "tabletop 10+2 contact-only" (movable + immovable) or the glob: runs of one setting are one row of a table.
  std::string setting() const;
  /// Names problem k among those of the source.
  std::string problem_name(int k) const;
  /// The class that a list gives problem k, or "".
  std::string listed_class(int k) const {
    return static_cast<std::size_t>(k) < listed.size() ? listed[static_cast<std::size_t>(k)] : "";
  }
};

/// Files that a glob matches, sorted; an error when there are none.
Result<std::vector<std::string>> match_files(const std::string& glob);
/// The source of a pattern: a glob, or "@LIST", a text file of one problem file a line, looked up from the list's own
/// folder, and optionally the class that somebody gave it (easy, medium, hard). Empty lines and "#" lines do not count.
Result<ProblemSource> file_source(const std::string& pattern, const std::string& folder);

/// Problem k, ready for a planner: the same bits that `mamo generate` writes and `mamo plan` loads.
Result<Problem> problem_of(const ProblemSource& source, int k);

}  // namespace mamo
