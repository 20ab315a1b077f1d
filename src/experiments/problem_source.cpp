#include "mamo/experiments/problem_source.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "io/native_problem.hpp"
#include "io/sha256.hpp"
#include "io/strict_reader.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/io/load.hpp"

namespace mamo {
namespace {

using Kind = ProblemSource::Kind;

constexpr std::uint64_t kSelfPairSeed = 1;  // as `mamo plan` chooses them

Result<Problem> generate(const ProblemSource& source, int k) {
  if (source.kind == Kind::tabletop) {
    TabletopSpec spec = source.tabletop;
    spec.index = k;
    return generate_tabletop(spec);
  }
  if (source.kind == Kind::shelf) {
    ShelfSpec spec = source.shelf;
    spec.index = k;
    return generate_shelf(spec);
  }
  RefrigeratorSpec spec = source.refrigerator;
  spec.index = k;
  return generate_refrigerator(spec);
}

/// A generated problem as `mamo plan` would read it from its file, bit for bit.
Result<Problem> as_loaded(const std::string& text, const std::string& name) {
  const auto root = io::parse_yaml(text, name);
  if (!root.ok()) return root.error();
  io::Complaints complaints(name);
  Problem problem;
  problem.name = problem.path = name;
  problem.sha256 = io::sha256_hex(text);
  io::read_native_problem(*root, {}, problem, complaints);
  if (complaints.any()) return complaints.first();
  choose_self_pairs(problem.robot, problem.robot_files.disabled, !problem.robot_files.srdf.empty(), kSelfPairSeed);
  return problem;
}

std::string objects_and_profile(int movable, int immovable, Profile profile) {
  return std::to_string(movable) + "+" + std::to_string(immovable) + " " + std::string(to_string(profile));
}

/// "PATH" or "PATH CLASS"; a class is a last word that is one.
std::pair<std::string, std::string> path_and_class(const std::string& line) {
  const std::size_t end = line.find_last_not_of(" \t\r");
  const std::string text = line.substr(0, end + 1);
  const std::size_t space = text.find_last_of(" \t");
  if (space != std::string::npos && parse_difficulty(text.substr(space + 1)))
    return {text.substr(0, text.find_last_not_of(" \t", space) + 1), text.substr(space + 1)};
  return {text, ""};
}

Result<ProblemSource> listed_source(const std::string& pattern, const std::string& folder) {
  const std::filesystem::path list = std::filesystem::path(folder) / pattern.substr(1);
  const Result<std::string> text = io::read_file(list.string());
  if (!text.ok()) return text.error();
  ProblemSource source;
  source.glob = "@" + list.filename().string();
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    const auto [path, given] = path_and_class(line);
    const std::string file = (list.parent_path() / path).lexically_normal().string();
    if (!std::filesystem::is_regular_file(file))
      return Error{list.string() + ":" + std::to_string(number) + ": no such problem file: '" + file + "'"};
    if (std::find(source.files.begin(), source.files.end(), file) != source.files.end())
      return Error{list.string() + ":" + std::to_string(number) + ": '" + file + "' stands twice"};
    source.files.push_back(file);
    source.listed.push_back(given);
  }
  if (source.files.empty()) return Error{list.string() + ": no problem file is listed"};
  return source;
}

}  // namespace

std::uint64_t ProblemSource::seed() const {
  return kind == Kind::shelf ? shelf.seed : kind == Kind::refrigerator ? refrigerator.seed : tabletop.seed;
}

std::string ProblemSource::setting() const {
  switch (kind) {
    case Kind::files:
      return glob;
    case Kind::tabletop:
      return "tabletop " + objects_and_profile(tabletop.movable, tabletop.immovable, tabletop.profile);
    case Kind::shelf:
      return "shelf " + objects_and_profile(shelf.movable, shelf.immovable, shelf.profile) +
             (shelf.difficulty ? " " + std::string(to_string(*shelf.difficulty)) : "");
    case Kind::refrigerator:
      return "refrigerator " + std::string(to_string(refrigerator.profile));
  }
  return "";
}

std::string ProblemSource::problem_name(int k) const {
  if (!generated()) return files[static_cast<std::size_t>(k)];
  return std::to_string(seed()) + "-" + std::to_string(k);
}

Result<std::vector<std::string>> match_files(const std::string& pattern) {
  glob_t matches{};
  const int status = glob(pattern.c_str(), 0, nullptr, &matches);
  std::vector<std::string> files;
  for (std::size_t i = 0; status == 0 && i < matches.gl_pathc; ++i) files.push_back(matches.gl_pathv[i]);
  globfree(&matches);
  if (files.empty()) return Error{"no file matches '" + pattern + "'"};
  std::sort(files.begin(), files.end());
  return files;
}

Result<ProblemSource> file_source(const std::string& pattern, const std::string& folder) {
  if (pattern.starts_with("@")) return listed_source(pattern, folder);
  const auto files = match_files((std::filesystem::path(folder) / pattern).string());
  if (!files.ok()) return files.error();
  ProblemSource source;
  source.glob = pattern;
  source.files = *files;
  source.listed.resize(files->size());
  return source;
}

Result<Problem> problem_of(const ProblemSource& source, int k) {
  if (source.generated()) {
    const Result<Problem> problem = generate(source, k);
    if (!problem.ok()) return problem;
    const Result<std::string> text = io::to_native_yaml(*problem);
    if (!text.ok()) return text.error();
    return as_loaded(*text, problem->name);
  }
  Result<Problem> problem = io::load_problem(source.files[static_cast<std::size_t>(k)]);
  if (problem.ok())
    choose_self_pairs(problem->robot, problem->robot_files.disabled, !problem->robot_files.srdf.empty(), kSelfPairSeed);
  return problem;
}

}  // namespace mamo
