#include "mamo/io/result_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

#include "io/notes_json.hpp"

#include "mamo/common/hash.hpp"

namespace mamo::io {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json numbers(const Eigen::VectorXd& q) {
  Json out = Json::array();
  for (double v : q) out.push_back(number(v));
  return out;
}

/// x y z qx qy qz qw.
Json pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  Json out = Json::array();
  for (double v : {X.translation().x(), X.translation().y(), X.translation().z(), q.x(), q.y(), q.z(), q.w()})
    out.push_back(number(v));
  return out;
}

template <class Map>
Json counts(const Map& map) {
  Json out = Json::object();
  for (const auto& [name, count] : map) out[name] = count;
  return out;
}

Json segment_object(const Segment& segment, const Scene& scene) {
  Json out;
  out["kind"] = std::string(to_string(segment.kind));
  out["object"] = segment.object.valid() ? Json(object_name(scene, segment.object)) : Json(nullptr);
  out["joint_names"] = segment.joint_names;
  out["points"] = Json::array();
  for (std::size_t i = 0; i < segment.motion.t.size() && i < segment.motion.q.size(); ++i)
    out["points"].push_back(Json{{"t", number(segment.motion.t[i])}, {"q", numbers(segment.motion.q[i])}});
  out["objects_after"] = Json::object();
  for (const auto& [id, X_WO] : segment.objects_after) out["objects_after"][object_name(scene, id)] = pose(X_WO);
  return out;
}

Json plan_object(const Plan& plan, const Scene& scene) {
  Json out;
  out["segments"] = Json::array();
  for (const Segment& segment : plan.segments) out["segments"].push_back(segment_object(segment, scene));
  return out;
}

Json stats_object(const PlanStats& s, const Scene& scene) {
  Json out;
  out["wall_s"] = number(s.wall_s);
  out["found_s"] = number(s.found_s);
  out["load_s"] = number(s.load_s);
  out["search_s"] = number(s.search_s);
  out["tracking_s"] = number(s.tracking_s);
  out["verification_s"] = number(s.verification_s);
  out["simulations"] = s.simulations;
  out["simulations_used"] = s.simulations_used;
  out["tracking_simulations"] = s.tracking_simulations;
  out["simulation_s"] = number(s.simulation_s);
  out["collision_checks"] = s.collision_checks;
  out["expansions"] = s.expansions;
  out["planning_iterations"] = s.planning_iterations;
  out["relevant_objects"] = Json::array();
  for (ObjectId id : s.relevant_objects) out["relevant_objects"].push_back(object_name(scene, id));
  out["mapf_calls"] = s.mapf_calls;
  out["mapf_s"] = number(s.mapf_s);
  out["push_attempts"] = s.push_attempts;
  out["push_planning_s"] = number(s.push_planning_s);
  out["cache_hits"] = s.cache_hits;
  out["peak_memory_mb"] = number(s.peak_memory_mb);
  out["failures"] = counts(s.failures);
  return out;
}

Json finding_object(const Verdict::Finding& finding, const Scene& scene) {
  const Violation& v = finding.violation;
  Json out;
  out["segment"] = finding.segment;
  out["time_s"] = number(v.time_s);
  out["kind"] = std::string(to_string(v.kind));
  out["object"] = object_name(scene, v.object);
  out["other"] = object_name(scene, v.other);
  out["value"] = number(v.value);
  out["limit"] = number(v.limit);
  out["unit"] = std::string(unit_of(v.kind));
  out["text"] = finding.text;
  return out;
}

/// Text that is no UTF-8 (a file name may be anything) is repaired, never thrown over.
std::string dump(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string object_name(const Scene& scene, ObjectId id) {
  if (id == kRobot) return "robot";
  if (id == kFloor) return "floor";
  return id.valid() && id.index() < scene.size() ? scene[id].id : "";
}

std::string result_json(const PlanResult& result, const Problem& problem, int indent) {
  Json out;
  out["schema"] = "mamo-result/1";
  out["status"] = std::string(to_string(result.status));
  out["exit_code"] = exit_code(result.status);
  out["reason"] = result.reason;
  out["planner"] = result.planner;
  out["problem"] = problem.name;
  out["problem_sha256"] = problem.sha256;
  out["version"] = MAMO_VERSION;
  out["seed"] = result.seed;
  out["threads"] = result.threads;
  out["signature"] = to_hex(result.signature);
  out["cost"] = result.cost;
  out["suboptimality_bound"] = number(result.suboptimality_bound);
  out["found"] = result.found;
  out["verified"] = result.verified;
  out["rejected_by_verification"] = result.rejected_by_verification;
  out["second_order_contacts"] = result.second_order_contacts;
  out["stats"] = stats_object(result.stats, problem.scene);
  out["plan"] = plan_object(result.plan, problem.scene);
  if (!result.notes.empty()) out["notes"] = notes_to_json(result.notes, problem.scene);
  return dump(out, indent);
}

std::string plan_json(const Plan& plan, const Scene& scene, int indent) {
  return dump(plan_object(plan, scene), indent);
}

std::string verdict_json(const Verdict& verdict, const Scene& scene, const RobustReport* robust, int indent) {
  const RobustReport none;
  const RobustReport& r = robust ? *robust : none;
  Json out;
  out["schema"] = "mamo-verdict/1";
  out["ok"] = verdict.ok;
  out["violations"] = Json::array();
  for (const Verdict::Finding& finding : verdict.findings) out["violations"].push_back(finding_object(finding, scene));
  out["robust"] = Json{{"n", r.n},
                       {"survived", r.survived},
                       {"rate", number(r.rate)},
                       {"ci95", {number(r.ci95[0]), number(r.ci95[1])}},
                       {"causes", counts(r.causes)}};
  return dump(out, indent);
}

}  // namespace mamo::io
