#include "mamo/experiments/suite.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "io/strict_reader.hpp"

#include "mamo/common/hash.hpp"
#include "mamo/common/nearest_name.hpp"
#include "mamo/io/load.hpp"
#include "mamo/io/profile.hpp"
#include "mamo/planners/registry.hpp"

namespace mamo {
namespace {

using io::Complaints;
using io::StrictMap;
using io::YamlValue;

constexpr int kMostProblems = 100000;

/// Reads the parts of a suite file; complaints go to one place.
class SuiteReader {
 public:
  SuiteReader(const std::string& path, Complaints& complaints) : path_(path), complaints_(complaints) {}

  Suite read(const YamlValue& root) {
    StrictMap map(root, "the suite", {"format", "problems", "planners", "limits", "seeds"}, complaints_);
    Suite suite;
    suite.name = std::filesystem::path(path_).stem().string();
    if (map.need_text("format") != "mamo-suite/1") complaints_.add(map.need("format"), "expected format: mamo-suite/1");
    RunLimits limits;
    if (const YamlValue* value = map.find("limits")) limits = read_limits(*value, limits);
    for (const YamlValue* item : items(map.need("problems"))) suite.problems.push_back(read_source(*item));
    for (const YamlValue* item : items(map.need("planners"))) suite.planners.push_back(read_planner(*item, limits));
    if (const YamlValue* seeds = map.find("seeds")) {
      suite.seeds.clear();
      for (const YamlValue* item : items(*seeds)) suite.seeds.push_back(whole(*item, "a seed", 0, 1e15));
    }
    check_labels(suite);
    return suite;
  }

 private:
  /// The items of a list, or the value itself: a list of one may go without brackets.
  std::vector<const YamlValue*> items(const YamlValue& value) {
    std::vector<const YamlValue*> all;
    if (!value.is_list()) return {&value};
    for (const YamlValue& item : value.items) all.push_back(&item);
    if (all.empty()) complaints_.add(value, "the list is empty");
    return all;
  }

  std::uint64_t whole(const YamlValue& value, const std::string& what, double least, double most) {
    const double number = io::read_number(value, what, {least, most, false, "a whole number in range"}, complaints_);
    if (number != std::floor(number)) complaints_.add(value, what + " must be a whole number");
    return static_cast<std::uint64_t>(std::max(0.0, number));
  }
  int whole(StrictMap& map, const std::string& key, int fallback, int least, int most) {
    const YamlValue* value = map.find(key);
    return value ? static_cast<int>(whole(*value, map.name_of(key), least, most)) : fallback;
  }

  RunLimits read_limits(const YamlValue& value, RunLimits limits) {
    StrictMap map(value, "limits", {"time", "simulations", "expansions"}, complaints_);
    if (map.has("time")) limits.time_s = map.number("time", 120, {1e-3, 1e9, true, "a time in seconds (> 0)"});
    const auto counted = [&](const char* key, std::int64_t& limit) {
      const YamlValue* given = map.find(key);
      if (!given) return;
      limit = given->kind == YamlValue::Kind::null ? std::numeric_limits<std::int64_t>::max()
                                                   : static_cast<std::int64_t>(whole(*given, key, 0, 1e15));
    };
    counted("simulations", limits.max_simulations);
    counted("expansions", limits.max_expansions);
    return limits;
  }

  ProblemSource read_source(const YamlValue& value) {
    StrictMap map(value, "problems",
                  {"generate", "movable", "immovable", "count", "seed", "constraints", "difficulty", "files"},
                  complaints_);
    if (map.has("generate") == map.has("files")) map.complain("problems need one of 'generate' and 'files'");
    if (map.has("files")) {
      auto source = file_source(map.text("files"), std::filesystem::path(path_).parent_path().string());
      if (source.ok()) return *source;
      map.complain(source.error().message);
      return {};
    }
    return read_generated(map);
  }

  ProblemSource read_generated(StrictMap& map) {
    using Kind = ProblemSource::Kind;
    ProblemSource source;
    const std::string what = map.need_text("generate");
    source.kind = what == "shelf" ? Kind::shelf : what == "refrigerator" ? Kind::refrigerator : Kind::tabletop;
    if (source.kind == Kind::tabletop && what != "tabletop")
      map.complain("expected generate: tabletop, shelf or refrigerator");
    if (source.kind == Kind::refrigerator && (map.has("movable") || map.has("immovable")))
      map.complain("a refrigerator holds what it holds: 'movable' and 'immovable' do not go with it");
    source.tabletop.movable = source.shelf.movable = whole(map, "movable", 10, 0, 1000);
    source.tabletop.immovable = whole(map, "immovable", 2, 0, 1000);
    source.shelf.immovable = whole(map, "immovable", 4, 0, 1000);
    source.count = whole(map, "count", 60, 1, kMostProblems);
    if (const YamlValue* seed = map.find("seed"))
      source.tabletop.seed = source.shelf.seed = source.refrigerator.seed = whole(*seed, "seed", 0, 1e15);
    const std::string constraints = map.text("constraints", source.kind == Kind::tabletop ? "contact-only" : "full");
    if (const auto profile = io::parse_profile(constraints); profile && *profile != Profile::legacy)
      source.tabletop.profile = source.shelf.profile = source.refrigerator.profile = *profile;
    else
      map.complain("constraints must be contact-only or full, not '" + constraints + "'");
    if (map.has("difficulty")) {
      source.shelf.difficulty = parse_difficulty(map.text("difficulty"));
      if (!source.shelf.difficulty || *source.shelf.difficulty == Difficulty::none || source.kind != Kind::shelf)
        map.complain("difficulty must be easy, medium or hard, and of a shelf");
    }
    return source;
  }

  PlannerEntry read_planner(const YamlValue& value, const RunLimits& limits) {
    StrictMap map(value, "a planner", {"name", "label", "set", "weight", "threads", "limits", "count"}, complaints_);
    PlannerEntry entry;
    entry.name = map.need_text("name");
    entry.label = map.text("label", entry.name);
    entry.weight = map.number("weight", 0, {1, 1e9, false, "a weight of 1 or more"});
    entry.threads = whole(map, "threads", 0, 1, 4096);
    entry.count = whole(map, "count", 0, 1, kMostProblems);
    entry.limits = limits;
    if (const YamlValue* own = map.find("limits")) entry.limits = read_limits(*own, limits);
    const std::vector<std::string> names = planner_names();
    if (std::find(names.begin(), names.end(), entry.name) == names.end())
      complaints_.add(map.need("name"),
                      "unknown planner '" + entry.name + "'; did you mean '" + nearest_name(entry.name, names) + "'?");
    if (const YamlValue* set = map.find("set")) {
      std::vector<std::string> known;
      for (const OptionDoc& option : planner_options(entry.name)) known.push_back(option.name);
      StrictMap options(*set, "options of " + entry.name, known, complaints_);
      for (const io::YamlMember& member : set->members) entry.set[member.key] = options.text(member.key);
    }
    return entry;
  }

  /// Runs are named by setting and label: two of one name could not be told apart.
  void check_labels(const Suite& suite) {
    std::set<std::string> seen;
    for (const PlannerEntry& planner : suite.planners)
      if (!seen.insert(planner.label).second)
        complaints_.add(1, 1, "two planners are called '" + planner.label + "'; 'label' tells them apart");
    seen.clear();
    for (const ProblemSource& source : suite.problems)
      if (!seen.insert(source.setting() + std::to_string(source.seed())).second)
        complaints_.add(1, 1, "the problems '" + source.setting() + "' stand twice in the suite");
  }

  std::string path_;
  Complaints& complaints_;
};

/// Names of files do not count, only what is planned with.
std::string settings_hash(const ProblemSource& source, const PlannerEntry& planner) {
  HashStream hash;
  hash.add(source.setting());
  hash.add(planner.name);
  for (const auto& [key, value] : planner.set) hash.add(key), hash.add(value);
  hash.add(planner.weight);
  hash.add(planner.threads);
  hash.add(planner.limits.time_s);
  hash.add(planner.limits.max_simulations);
  hash.add(planner.limits.max_expansions);
  return to_hex(hash.value());
}

}  // namespace

Result<Suite> read_suite(const std::string& path) {
  const auto text = io::read_file(path);
  if (!text.ok()) return text.error();
  const auto root = io::parse_yaml(*text, path);
  if (!root.ok()) return root.error();
  Complaints complaints(path);
  Suite suite = SuiteReader(path, complaints).read(*root);
  if (complaints.any()) return complaints.first();
  return suite;
}

std::vector<BenchRun> runs_of(const Suite& suite) {
  std::vector<BenchRun> runs;
  int index = 0;
  for (std::size_t s = 0; s < suite.problems.size(); ++s)
    for (int k = 0; k < suite.problems[s].size(); ++k, ++index)
      for (std::uint64_t seed : suite.seeds)
        for (std::size_t p = 0; p < suite.planners.size(); ++p) {
          const ProblemSource& source = suite.problems[s];
          const PlannerEntry& planner = suite.planners[p];
          if (planner.count > 0 && k >= planner.count) continue;
          BenchRun run;
          run.index = index;
          run.id = suite.name + "/" + source.setting() + "/" + source.problem_name(k) + "/" + planner.label + "/" +
                   std::to_string(seed);
          run.settings = settings_hash(source, planner);
          run.source = s;
          run.planner = p;
          run.problem = k;
          run.seed = seed;
          runs.push_back(std::move(run));
        }
  return runs;
}

Result<Problem> problem_of(const Suite& suite, const BenchRun& run) {
  return problem_of(suite.problems[run.source], run.problem);
}

}  // namespace mamo
