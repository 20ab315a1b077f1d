#include "mamo/view/describe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo::view {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string fixed3(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value + 0.0);
  return std::string(text) == "-0.000" ? "0.000" : text;
}

std::string position(const Eigen::Vector3d& p) { return fixed3(p.x()) + " " + fixed3(p.y()) + " " + fixed3(p.z()); }

/// Fixed-axis roll, pitch, yaw (rad).
std::string rotation(const Eigen::Matrix3d& R) {
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  const double roll = std::atan2(R(2, 1), R(2, 2)), yaw = std::atan2(R(1, 0), R(0, 0));
  return position({roll, pitch, yaw});
}

std::string pose(const Eigen::Isometry3d& X) {
  return "position " + position(X.translation()) + ", rpy " + rotation(X.linear());
}

std::string type_name(JointType type) {
  switch (type) {
    case JointType::fixed: return "fixed";
    case JointType::revolute: return "revolute";
    case JointType::continuous: return "continuous";
    case JointType::prismatic: return "prismatic";
  }
  return "unknown";
}

std::string kind_name(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::fixture: return "fixture";
    case ObjectKind::immovable: return "immovable";
    case ObjectKind::movable: return "movable";
  }
  return "unknown";
}

std::string touch_name(Touch touch) {
  switch (touch) {
    case Touch::allowed: return "allowed";
    case Touch::robot: return "robot";
    case Touch::objects: return "objects";
    case Touch::forbidden: return "forbidden";
    case Touch::support: return "support";
  }
  return "unknown";
}

/// Columns as wide as their widest cell; the last one is not padded.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += " " + row[c];
      if (c + 1 < row.size()) line += std::string(widths[c] - row[c].size() + 1, ' ');
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string limits_of(const Object& object) {
  const InteractionConstraints& c = object.constraints;
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (std::isfinite(c.max_tilt)) add("tilt " + number(c.max_tilt) + " rad");
  if (std::isfinite(c.max_speed)) add("speed " + number(c.max_speed) + " m/s");
  if (!c.may_leave_support) add("stays on its support");
  if (std::isfinite(c.max_displacement)) add("displacement " + number(c.max_displacement) + " m");
  return out.empty() ? "-" : out;
}

std::string scene_table(const Scene& scene) {
  std::vector<std::vector<std::string>> rows = {
      {"id", "kind", "shape", "position", "rpy", "mass", "friction", "touch", "limits"}};
  for (const Object& object : scene.objects) {
    std::string shape = object.shapes.empty() ? "none" : mamo::describe(object.shapes.front().shape);
    if (object.shapes.size() > 1) shape += " and " + std::to_string(object.shapes.size() - 1) + " more";
    rows.push_back({object.id, kind_name(object.kind), shape, position(object.X_WO.translation()),
                    rotation(object.X_WO.linear()), object.fixture() ? "-" : number(object.mass),
                    number(object.friction), touch_name(object.constraints.touch), limits_of(object)});
  }
  return table(rows);
}

std::string task_text(const Problem& problem) {
  const auto name = [&](ObjectId id) { return id.valid() ? problem.scene[id].id : std::string("nothing"); };
  if (const ReachPose* reach = std::get_if<ReachPose>(&problem.task)) {
    std::string text = "reach: tip to " + pose(reach->X_WT) + ", within " + number(reach->position_tolerance) +
                       " m and " + number(reach->angle_tolerance) + " rad";
    return reach->target.valid() ? text + ", without touching " + name(reach->target) : text;
  }
  if (const ReachJoints* joints = std::get_if<ReachJoints>(&problem.task)) {
    std::string text = "reach: joints to";
    for (Eigen::Index i = 0; i < joints->q.size(); ++i) text += " " + number(joints->q[i]);
    return text + ", within " + number(joints->tolerance);
  }
  const Retrieve& retrieve = std::get<Retrieve>(problem.task);
  return "retrieve: " + name(retrieve.object) + ", pre-grasp at " + pose(retrieve.X_WT_pregrasp) + ", home within " +
         number(retrieve.home_tolerance) + " rad";
}

std::string pairs_text(const RobotModel& model, const std::vector<std::pair<LinkId, LinkId>>& pairs) {
  std::string out;
  for (const auto& [a, b] : pairs)
    out += "  " + model.links[a.index()].name + " - " + model.links[b.index()].name + "\n";
  return out;
}

}  // namespace

std::string describe(const Robot& robot) {
  const RobotModel& model = *robot.model;
  std::size_t shapes = 0;
  for (const Link& link : model.links) shapes += link.collision.size();
  std::string out = "robot " + model.name + ": " + std::to_string(robot.dof()) + " joints plan, " +
                    std::to_string(model.joints.size()) + " in all, " + std::to_string(model.links.size()) +
                    " links, " + std::to_string(shapes) + " collision shapes\n";
  if (!model.source.empty()) out += "  from " + model.source + "\n";
  const auto link_name = [&](LinkId id) { return id.valid() ? model.links[id.index()].name : std::string("?"); };
  out += "  base " + link_name(robot.group.base) + ", tip " + link_name(robot.group.tip) + ", root at " +
         pose(robot.X_WB) + "\n";
  out += "  speed " + number(robot.speed_scale) + " of the velocity limits\n";
  std::vector<std::vector<std::string>> rows = {{"joint", "type", "lower", "upper", "velocity", "start"}};
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& joint = robot.joint(i);
    rows.push_back({joint.name, type_name(joint.type), number(joint.lower), number(joint.upper),
                    number(joint.max_velocity), number(robot.posture[joint.variable])});
  }
  out += table(rows);
  out += "self-collision: " + std::to_string(robot.self_pairs.size()) + " pairs of links are checked, " +
         std::to_string(robot.disabled_pairs.size()) + " disabled because they always collide\n";
  return out + pairs_text(model, robot.disabled_pairs);
}

std::string describe(const Problem& problem) {
  std::string out = "problem " + problem.name + "\n";
  if (!problem.path.empty()) out += "  from " + problem.path + "\n";
  if (!problem.sha256.empty()) out += "  sha256 " + problem.sha256 + "\n";
  out += describe(problem.robot);
  const auto count = [&](ObjectKind kind) { return ObjectSet::of_kind(problem.scene, kind).ids().size(); };
  out += "scene: " + std::to_string(count(ObjectKind::fixture)) + " fixtures, " +
         std::to_string(count(ObjectKind::immovable)) + " immovable, " + std::to_string(count(ObjectKind::movable)) +
         " movable\n" + scene_table(problem.scene);
  out += "task " + task_text(problem) + "\n";
  out += "constraints " + std::string(to_string(problem.profile)) + "\n";
  const PhysicsSettings& physics = problem.scene.physics;
  out += "physics: step " + number(physics.step) + " s, " + std::to_string(physics.iterations) +
         " iterations, robot friction " + number(physics.robot_friction) + ", settle time " +
         number(physics.settle_time) + " s\n";
  if (!problem.generated.empty()) {
    out += "generated:\n";
    for (const auto& [key, value] : problem.generated) out += "  " + key + ": " + value + "\n";
  }
  for (const std::string& warning : problem.warnings) out += "warning: " + warning + "\n";
  return out;
}

std::string describe(const Plan& plan, const Problem& problem) {
  double duration = 0;
  std::size_t points = 0;
  std::vector<std::vector<std::string>> rows = {{"segment", "kind", "object", "points", "duration", "joint path"}};
  std::map<ObjectId, Eigen::Isometry3d> final_poses;
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    const Segment& segment = plan.segments[s];
    double length = 0;
    for (std::size_t k = 1; k < segment.motion.q.size(); ++k)
      length += (segment.motion.q[k] - segment.motion.q[k - 1]).cwiseAbs().sum();
    duration += segment.motion.duration();
    points += segment.motion.t.size();
    rows.push_back({std::to_string(s), std::string(to_string(segment.kind)),
                    segment.object.valid() ? problem.scene[segment.object].id : "-",
                    std::to_string(segment.motion.t.size()), fixed3(segment.motion.duration()) + " s",
                    fixed3(length) + " rad"});
    for (const auto& [id, X] : segment.objects_after) final_poses[id] = X;
  }
  std::string out = "plan: " + std::to_string(plan.segments.size()) + " segments, " + std::to_string(points) +
                    " points, " + fixed3(duration) + " s\n" + table(rows);
  for (const auto& [id, X] : final_poses) {
    const double moved = (X.translation() - problem.scene[id].X_WO.translation()).norm();
    if (moved > 0.005)
      out += "moves " + problem.scene[id].id + " by " + fixed3(moved) + " m to " + position(X.translation()) + "\n";
  }
  return out;
}

}  // namespace mamo::view
