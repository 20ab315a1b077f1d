// A result object read back for people to look at: how the run went, its notes, its plan.
#include <nlohmann/json.hpp>

#include "io/notes_json.hpp"

#include "mamo/io/load.hpp"

namespace mamo::io {
namespace {

using Json = nlohmann::json;

std::string text(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

template <class T>
void read(const Json& json, const char* key, T& value) {
  const auto found = json.find(key);
  if (found == json.end()) return;
  if constexpr (std::is_same_v<T, bool>) {
    if (found->is_boolean()) value = found->get<bool>();
  } else {
    if (found->is_number()) value = found->get<T>();
  }
}

PlanStatus status_of(const std::string& name) {
  for (PlanStatus status : {PlanStatus::solved, PlanStatus::limit, PlanStatus::timeout, PlanStatus::proven,
                            PlanStatus::interrupted, PlanStatus::memory, PlanStatus::invalid, PlanStatus::error})
    if (to_string(status) == name) return status;
  return PlanStatus::error;
}

void read_stats(const Json& json, const Scene& scene, PlanStats& stats) {
  read(json, "wall_s", stats.wall_s);
  read(json, "load_s", stats.load_s);
  read(json, "search_s", stats.search_s);
  read(json, "tracking_s", stats.tracking_s);
  read(json, "verification_s", stats.verification_s);
  read(json, "simulations", stats.simulations);
  read(json, "simulations_used", stats.simulations_used);
  read(json, "tracking_simulations", stats.tracking_simulations);
  read(json, "expansions", stats.expansions);
  read(json, "planning_iterations", stats.planning_iterations);
  read(json, "mapf_calls", stats.mapf_calls);
  read(json, "push_attempts", stats.push_attempts);
  if (const auto ids = json.find("relevant_objects"); ids != json.end() && ids->is_array())
    for (const Json& id : *ids)
      if (const ObjectId object = id.is_string() ? scene.find(id.get<std::string>()) : kNoObject; object.valid())
        stats.relevant_objects.push_back(object);
  if (const auto failures = json.find("failures"); failures != json.end() && failures->is_object())
    for (const auto& [cause, count] : failures->items())
      if (count.is_number_integer()) stats.failures[cause] = count.get<std::int64_t>();
}

}  // namespace

Result<PlanResult> load_result(const std::string& path, const Problem& problem) {
  Result<std::string> bytes = read_file(path, 256u << 20);
  if (!bytes) return bytes.error();
  const Json json = Json::parse(*bytes, nullptr, false);
  PlanResult result;
  result.status = PlanStatus::solved;  // a bare plan
  if (json.is_object() && !text(json, "status").empty()) {
    result.status = status_of(text(json, "status"));
    result.reason = text(json, "reason");
    result.planner = text(json, "planner");
    read(json, "seed", result.seed);
    read(json, "cost", result.cost);
    read(json, "suboptimality_bound", result.suboptimality_bound);
    read(json, "found", result.found);
    read(json, "verified", result.verified);
    read(json, "rejected_by_verification", result.rejected_by_verification);
    if (const auto stats = json.find("stats"); stats != json.end() && stats->is_object())
      read_stats(*stats, problem.scene, result.stats);
    if (const auto notes = json.find("notes"); notes != json.end())
      result.notes = notes_from_json(*notes, problem.scene);
    if (result.status != PlanStatus::solved) return result;
  }
  Result<Plan> plan = load_plan(path, problem);
  if (!plan) return plan.error();
  result.plan = std::move(*plan);
  return result;
}

}  // namespace mamo::io
