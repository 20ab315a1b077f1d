#include "view/page_data.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

#include "view/geometry_table.hpp"
#include "view/layers.hpp"
#include "view/palette.hpp"
#include "view/series.hpp"

#include "mamo/io/result_json.hpp"

namespace mamo::view {
namespace {

using Json = nlohmann::json;

Json limit(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string name_of(const Scene& scene, ObjectId id) { return io::object_name(scene, id); }

Json robot_json(const Stage& stage, GeometryTable& table) {
  const Robot& robot = stage.problem().robot;
  const RobotModel& model = *robot.model;
  const std::vector<bool> moving = robot.moving_links();
  const VisualMeshes visuals(model, kVisualBudget);
  Json out;
  out["name"] = model.name;
  out["base"] = pose_json(robot.X_WB);
  out["posture"] = std::vector<double>(robot.posture.begin(), robot.posture.end());
  out["group"] = Json::array();
  for (JointId id : robot.group.joints) out["group"].push_back(model.joints[id.index()].variable);
  out["tip"] = robot.group.tip.value;
  out["links"] = Json::array();
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    const Link& link = model.links[l];
    Json entry{{"name", link.name}, {"moves", static_cast<bool>(moving[l])}};
    if (link.parent_joint.valid()) {
      const Joint& joint = model.joints[link.parent_joint.index()];
      entry["parent"] = joint.parent.value;
      entry["X"] = pose_json(joint.X_PJ);
      const Joint& source = joint.mimic ? model.joints[joint.mimic->joint.index()] : joint;
      if (joint.type != JointType::fixed && source.variable >= 0) {
        entry["variable"] = source.variable;
        entry["axis"] = point_json(joint.axis);
        entry["slides"] = joint.type == JointType::prismatic;
        entry["times"] = joint.mimic ? joint.mimic->multiplier : 1.0;
        entry["plus"] = joint.mimic ? joint.mimic->offset : 0.0;
      }
    }
    entry["collision"] = Json::array();
    for (const PlacedShape& s : link.collision) entry["collision"].push_back({table.add(s.shape), pose_json(s.X_BS)});
    Json seen = Json::array();
    for (const VisualGeometry& visual : link.visual) {
      const TriangleMesh* mesh = visual.shape ? nullptr : visuals.find(visual);
      if (!visual.shape && !mesh) continue;
      seen.push_back({visual.shape ? table.add(*visual.shape) : table.add(*mesh), pose_json(visual.X_LV),
                      point_json(visual.rgba.head<3>())});
    }
    if (!seen.empty()) entry["visual"] = std::move(seen);
    out["links"].push_back(std::move(entry));
  }
  return out;
}

Json objects_json(const Stage& stage, GeometryTable& table) {
  Json out = Json::array();
  for (const StageObject& shown : stage.objects()) {
    const Object& object = stage.problem().scene[shown.id];
    Json shapes = Json::array();
    for (const PlacedShape& s : object.shapes) shapes.push_back({table.add(s.shape), pose_json(s.X_BS)});
    static constexpr const char* kKinds[] = {"fixture", "immovable", "movable"};
    Json entry{{"id", object.id},
               {"kind", kKinds[static_cast<int>(object.kind)]},
               {"role", shown.role},
               {"shapes", std::move(shapes)},
               {"X", pose_json(object.X_WO)},
               {"mass", object.mass},
               {"maxTilt", limit(object.constraints.max_tilt)},
               {"maxSpeed", limit(object.constraints.max_speed)}};
    if (shown.see_through) entry["seeThrough"] = true;
    if (shown.relevant > 0) entry["relevant"] = shown.relevant;
    if (shown.touched) entry["touched"] = true;
    out.push_back(std::move(entry));
  }
  return out;
}

/// Quaternions keep to one of their two signs from sample to sample, so that they can be interpolated as they stand.
Json track_json(const Recording::Track& track) {
  std::array<std::vector<double>, 7> columns;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  for (const Eigen::Isometry3d& X : track.X_WO) {
    Eigen::Quaterniond q(X.linear());
    if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
    last = q;
    const std::array<double, 7> row = {
        X.translation().x(), X.translation().y(), X.translation().z(), q.x(), q.y(), q.z(), q.w()};
    for (std::size_t i = 0; i < 7; ++i) columns[i].push_back(row[i]);
  }
  Json out{{"pose", Json::array()}, {"tilt", series(track.tilt, 1e-4)}, {"speed", series(track.speed, 1e-4)}};
  for (std::size_t i = 0; i < 7; ++i) out["pose"].push_back(series(columns[i], i < 3 ? 1e-5 : 1e-4));
  return out;
}

Json recording_json(const Recording& recording) {
  Json out{{"t", series(recording.t, 1e-4)}, {"q", Json::array()}, {"tracks", Json::object()}};
  for (Eigen::Index i = 0; i < recording.q.front().size(); ++i) {
    std::vector<double> values;
    for (const Eigen::VectorXd& q : recording.q) values.push_back(q[i]);
    out["q"].push_back(series(values, 1e-4));
  }
  for (const auto& [id, track] : recording.tracks) out["tracks"][std::to_string(id.value)] = track_json(track);
  out["contacts"] = Json::array();
  for (const Recording::Contact& c : recording.contacts)
    out["contacts"].push_back({{"a", c.a.value},
                               {"b", c.b.value},
                               {"from", c.begin_s},
                               {"to", c.end_s},
                               {"depth", c.depth},
                               {"p", point_json(c.p_W)}});
  if (recording.grasped_s >= 0) out["grasped"] = recording.grasped_s;
  return out;
}

Json layers_json(const Stage& stage) {
  Json out = Json::array();
  for (const NoteLayer& layer : page_layers(stage)) {
    Json entry{{"name", layer.name}, {"about", layer.about}, {"items", Json::array()}};
    for (const NoteItem& item : layer.items) {
      Json points = Json::array();
      for (const Eigen::Vector3d& p : item.points) points.push_back(point_json(p));
      Json shown{{"text", item.text}, {"points", std::move(points)}};
      if (item.object.valid()) shown["object"] = item.object.value;
      if (item.iteration >= 0) shown["iteration"] = item.iteration;
      entry["items"].push_back(std::move(shown));
    }
    if (!layer.cells.indices.empty()) {
      std::array<std::vector<double>, 3> columns;
      for (const auto& index : layer.cells.indices)
        for (std::size_t i = 0; i < 3; ++i) columns[i].push_back(index[i]);
      entry["cells"] = {{"size", layer.cells.cell},
                        {"origin", point_json(layer.cells.origin)},
                        {"indices", {series(columns[0], 1), series(columns[1], 1), series(columns[2], 1)}}};
      if (!layer.cells.values.empty()) entry["cells"]["values"] = series(layer.cells.values, 1e-2);
    }
    out.push_back(std::move(entry));
  }
  return out;
}

std::string number(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string task_text(const Stage& stage) {
  const std::string target = stage.target().valid() ? stage.problem().scene[stage.target()].id : "";
  if (std::holds_alternative<ReachJoints>(stage.problem().task)) return "reach a configuration";
  if (std::holds_alternative<Retrieve>(stage.problem().task)) return "retrieve " + target;
  return target.empty() ? "reach a pose" : "reach a pose at " + target;
}

/// What the page says of the run, as rows of a table.
Json facts_json(const Stage& stage) {
  Json facts = Json::array();
  const auto add = [&](const char* name, const std::string& value) { facts.push_back({name, value}); };
  const Problem& problem = stage.problem();
  add("robot", problem.robot.model->name);
  add("task", task_text(stage));
  add("constraints", std::string(to_string(problem.profile)));
  const PlanResult* result = stage.playback().result;
  if (!result || result->planner.empty()) return facts;
  const PlanStats& stats = result->stats;
  add("planner", result->planner + ", seed " + std::to_string(result->seed));
  if (!result->plan.empty()) add("cost", number("%.2f rad", static_cast<double>(result->cost) / 1000));
  add("planned in", number("%.2f s", stats.wall_s - stats.load_s));
  add("simulations", std::to_string(stats.simulations_used) + " of the search, " +
                         std::to_string(stats.tracking_simulations) + " of tracking");
  add("expansions", std::to_string(stats.expansions));
  if (stats.planning_iterations > 0) add("planning iterations", std::to_string(stats.planning_iterations));
  std::string relevant;
  for (ObjectId id : stats.relevant_objects) relevant += (relevant.empty() ? "" : ", ") + name_of(problem.scene, id);
  if (!relevant.empty()) add("relevant, in order", relevant);
  std::string failures;
  for (const auto& [cause, count] : stats.failures)
    failures += (failures.empty() ? "" : ", ") + cause + " " + std::to_string(count);
  if (!failures.empty()) add("failures on the way", failures);
  return facts;
}

Json outcome_json(const Stage& stage) {
  const PlanResult* result = stage.playback().result;
  const Verdict* verdict = stage.playback().verdict;
  const bool planned = result && !result->plan.empty();
  Json out{{"kind", "problem"}, {"headline", "problem"}, {"reason", ""}};
  if (result && result->status != PlanStatus::solved && !planned)
    out = {{"kind", "failed"},
           {"headline", "no plan: " + std::string(to_string(result->status))},
           {"reason", result->reason}};
  if (planned && verdict)
    out = {{"kind", verdict->ok ? "holds" : "failed"},
           {"headline", verdict->ok ? "holds in full physics" : "does not hold"},
           {"reason", verdict->findings.empty() ? "" : verdict->findings.front().text}};
  out["findings"] = Json::array();
  if (!verdict) return out;
  for (const Verdict::Finding& finding : verdict->findings) {
    Json entry{{"text", finding.text}, {"t", finding.violation.time_s}};
    if (const auto place = stage.place_of(finding.violation)) entry["p"] = point_json(*place);
    out["findings"].push_back(std::move(entry));
  }
  return out;
}

Json segments_json(const Stage& stage) {
  Json out = Json::array();
  for (const StageSegment& segment : stage.segments())
    out.push_back({{"kind", std::string(to_string(segment.kind))},
                   {"object", name_of(stage.problem().scene, segment.object)},
                   {"from", segment.begin_s},
                   {"to", segment.end_s}});
  return out;
}

Json camera_json(const Camera& camera) {
  return {{"target", point_json(camera.target)},
          {"yaw", camera.yaw},
          {"pitch", camera.pitch},
          {"distance", camera.distance},
          {"fov", Camera::kFieldOfView}};
}

}  // namespace

std::string page_data(const Stage& stage) {
  GeometryTable table;
  Json out;
  out["title"] = stage.problem().name;
  out["robot"] = robot_json(stage, table);
  out["objects"] = objects_json(stage, table);
  out["geometry"] = table.take();
  out["segments"] = segments_json(stage);
  out["outcome"] = outcome_json(stage);
  out["facts"] = facts_json(stage);
  out["layers"] = layers_json(stage);
  out["camera"] = camera_json(stage.camera());
  if (const auto goal = stage.goal()) out["goal"] = pose_json(*goal);
  if (stage.playback().recording) out["recording"] = recording_json(*stage.playback().recording);
  const std::string text = out.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;  // "</script>" in a name must not end the script
  for (char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return safe;
}

}  // namespace mamo::view
