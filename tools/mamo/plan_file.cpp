#include "plan_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <set>

#include "mamo/io/load.hpp"

namespace mamo::tool {
namespace {

using Json = nlohmann::json;

/// null when the file is missing or no JSON.
Json parse(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text.ok()) return nullptr;
  Json json = Json::parse(*text, nullptr, false);
  return json.is_object() ? json : Json();
}

std::string text_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

struct Names {
  std::vector<std::string> joints;  // in order of first appearance
  std::set<std::string> objects;
};

void collect(const Json& segment, Names& names) {
  if (!segment.is_object()) return;
  const Json joints = segment.value("joint_names", Json::array());
  for (const Json& name : joints)
    if (name.is_string() && std::find(names.joints.begin(), names.joints.end(), name) == names.joints.end())
      names.joints.push_back(name);
  const Json objects = segment.value("objects_after", Json::object());
  for (const auto& [id, pose] : objects.items()) names.objects.insert(id);
  if (const std::string object = text_of(segment, "object"); !object.empty()) names.objects.insert(object);
}

Robot robot_with(const std::vector<std::string>& joints) {
  auto model = std::make_shared<RobotModel>();
  model->name = "unknown";
  model->links.push_back({"link0", JointId{-1}, {}, {}, 0});
  for (const std::string& name : joints) {
    Joint joint;
    joint.name = name;
    joint.type = JointType::continuous;
    joint.parent = LinkId(model->links.size() - 1);
    joint.child = LinkId(model->links.size());
    joint.variable = model->variables++;
    joint.max_velocity = std::numeric_limits<double>::infinity();
    model->variable_joint.push_back(JointId(model->joints.size()));
    model->links.push_back({"link" + std::to_string(model->links.size()), JointId(model->joints.size()), {}, {}, 0});
    model->joints.push_back(joint);
  }
  Robot robot;
  robot.group.joints = model->variable_joint;
  robot.group.base = LinkId{0};
  robot.group.tip = LinkId(model->links.size() - 1);
  robot.posture = Eigen::VectorXd::Zero(model->variables);
  robot.model = std::move(model);
  return robot;
}

}  // namespace

PlanFacts read_plan_facts(const std::string& path) {
  const Json json = parse(path);
  if (!json.is_object()) return {};
  return {text_of(json, "planner"), text_of(json, "status"), text_of(json, "problem"), text_of(json, "problem_sha256"),
          text_of(json, "signature")};
}

Problem stand_in_problem(const std::string& plan_path) {
  const Json json = parse(plan_path);
  Names names;
  if (json.is_object()) {
    const Json plan = json.contains("plan") ? json["plan"] : json;
    if (plan.is_object())
      for (const Json& segment : plan.value("segments", Json::array())) collect(segment, names);
  }
  Problem problem;
  problem.name = std::filesystem::path(plan_path).filename();
  problem.path = plan_path;
  problem.robot = robot_with(names.joints);
  problem.q_start = problem.robot.posture;
  for (const std::string& id : names.objects) {
    Object object;
    object.id = id;
    object.shapes = {{Sphere{0.01}, Eigen::Isometry3d::Identity()}};
    problem.scene.objects.push_back(object);
  }
  return problem;
}

}  // namespace mamo::tool
