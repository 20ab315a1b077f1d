#include "mamo/experiments/record.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "mamo/common/hash.hpp"
#include "mamo/io/load.hpp"
#include "mamo/io/result_json.hpp"

namespace mamo {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

Json limit(std::int64_t value) { return value == kNone ? Json(nullptr) : Json(value); }
Json limit(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

int count(const Scene& scene, ObjectKind kind) {
  int found = 0;
  for (const Object& object : scene.objects) found += object.kind == kind;
  return found;
}

Json goal_tolerance(const Task& task) {
  if (const auto* pose = std::get_if<ReachPose>(&task))
    return Json{{"position", pose->position_tolerance}, {"angle", pose->angle_tolerance}};
  if (const auto* joints = std::get_if<ReachJoints>(&task)) return Json{{"joints", joints->tolerance}};
  return Json{{"home", std::get<Retrieve>(task).home_tolerance}};
}

/// The number under a key; 0 for null and for what is not there.
template <class T>
T number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<T>() : T{};
}

/// The text under a key; "" for null and for what is not there.
std::string optional_text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}
Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// A number that the generator noted as text.
int noted(const Json& generated, const char* key) {
  const auto found = generated.find(key);
  return found != generated.end() && found->is_string() ? std::atoi(found->get<std::string>().c_str()) : 0;
}

Record record_of(const Json& json) {
  Record r;
  const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
  r.suite = text("suite");
  r.run = text("run");
  r.settings = text("settings");
  r.setting = text("setting");
  r.label = text("label");
  r.planner = text("planner");
  r.problem = text("problem");
  r.problem_sha256 = text("problem_sha256");
  r.constraints = text("constraints");
  r.status = text("status");
  r.reason = text("reason");
  r.commit = text("commit");
  r.machine = json.at("machine").dump();
  r.version = optional_text(json, "version");
  r.processor = optional_text(json.at("machine"), "processor");
  r.started = optional_text(json, "started");
  r.seed = json.at("seed").get<std::uint64_t>();
  r.movable = json.at("movable").get<int>();
  r.immovable = json.at("immovable").get<int>();
  r.threads = json.at("threads").get<int>();
  r.redraws = noted(json.at("generated"), "goal_redraws") + noted(json.at("generated"), "scene_redraws");
  r.found = json.at("found").get<bool>();
  r.solved = r.status == "solved";
  r.bound = number<double>(json, "suboptimality_bound");
  r.weight = number<double>(json, "weight");
  r.position_tolerance = number<double>(json.at("goal_tolerance"), "position");
  r.angle_tolerance = number<double>(json.at("goal_tolerance"), "angle");
  r.time_limit_s = number<double>(json.at("limits"), "time");
  if (r.time_limit_s <= 0) r.time_limit_s = std::numeric_limits<double>::infinity();
  const Json& stats = json.at("stats");
  r.time_s = number<double>(stats, "wall_s") - number<double>(stats, "load_s");
  r.found_s = number<double>(stats, "found_s");
  r.simulations = number<std::int64_t>(stats, "simulations_used");
  r.tracking = number<std::int64_t>(stats, "tracking_simulations");
  r.expansions = number<std::int64_t>(stats, "expansions");
  r.iterations = number<int>(stats, "planning_iterations");
  r.relevant = static_cast<int>(stats.at("relevant_objects").size());
  r.mapf_s = number<double>(stats, "mapf_s");
  r.push_planning_s = number<double>(stats, "push_planning_s");
  r.simulation_s = number<double>(stats, "simulation_s");
  r.push_attempts = number<std::int64_t>(stats, "push_attempts");
  r.pushes = number<int>(json, "pushes");
  r.difficulty = optional_text(json, "difficulty");
  r.difficulty_listed = optional_text(json, "difficulty_listed");
  return r;
}

}  // namespace

std::string bench_line(const Suite& suite, const BenchRun& run, const PlanResult& result, const Problem& problem,
                       const RunMachine& machine, const std::string& started, bool keep_plan,
                       const std::string& difficulty) {
  const ProblemSource& source = suite.problems[run.source];
  const PlannerEntry& planner = suite.planners[run.planner];
  Json json = Json::parse(io::result_json(result, problem));
  if (!keep_plan) json["plan"] = nullptr;
  json["suite"] = suite.name;
  json["run"] = run.id;
  json["settings"] = run.settings;
  json["setting"] = source.setting();
  json["label"] = planner.label;
  json["movable"] = count(problem.scene, ObjectKind::movable);
  json["immovable"] = count(problem.scene, ObjectKind::immovable);
  json["constraints"] = std::string(to_string(problem.profile));
  json["generated"] = problem.generated;
  json["difficulty"] = text_or_null(difficulty);
  json["difficulty_listed"] = text_or_null(source.generated() ? "" : source.listed_class(run.problem));
  json["pushes"] = std::count_if(result.plan.segments.begin(), result.plan.segments.end(),
                                 [](const Segment& s) { return s.kind == SegmentKind::push; });
  json["options"] = planner.set;
  json["weight"] = planner.weight > 0 ? Json(planner.weight) : Json(nullptr);
  json["goal_tolerance"] = goal_tolerance(problem.task);
  json["limits"] = Json{{"time", limit(planner.limits.time_s)},
                        {"simulations", limit(planner.limits.max_simulations)},
                        {"expansions", limit(planner.limits.max_expansions)}};
  json["machine"] = Json::parse(machine.json);
  json["commit"] = machine.commit;
  json["started"] = started;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Record> parse_record(const std::string& line, const std::string& place) {
  try {
    return record_of(Json::parse(line));
  } catch (const nlohmann::json::exception& error) {
    return Error{place + ": not a line of mamo bench: " + error.what()};
  }
}

Result<std::vector<Record>> read_records(const std::string& path) {
  const auto text = io::read_file(path, std::size_t{4} << 30);
  if (!text.ok()) return text.error();
  std::vector<Record> records;
  std::size_t start = 0;
  for (int number = 1; start < text->size(); ++number) {
    const std::size_t end = text->find('\n', start);
    if (end == std::string::npos) break;
    auto record = parse_record(text->substr(start, end - start), path + ":" + std::to_string(number));
    if (!record.ok()) return record.error();
    records.push_back(std::move(*record));
    start = end + 1;
  }
  return records;
}

std::string page_file_name(const std::string& run) {
  std::string name;
  for (char c : run) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' ? c : '_';
  HashStream hash;  // names that differ in other characters stay apart
  for (char c : run) hash.add(static_cast<std::int64_t>(c));
  return name + "-" + to_hex(hash.value()).substr(0, 8) + ".html";
}

}  // namespace mamo
