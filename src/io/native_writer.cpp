// The native problem file of a problem: everything that load_problem reads back, nothing that is a default.
#include <array>
#include <cstdlib>
#include <filesystem>

#include "io/text.hpp"
#include "mamo/io/load.hpp"
#include "mamo/io/profile.hpp"

namespace mamo::io {
namespace {

std::string vector_text(const Eigen::Vector3d& v) { return yaml_list(std::array{v.x(), v.y(), v.z()}); }

std::string pose_text(const Eigen::Isometry3d& X) {
  std::string text = "{position: " + vector_text(X.translation());
  if (X.linear() != Eigen::Matrix3d::Identity()) {
    const Eigen::Quaterniond q(X.linear());
    text += ", quaternion: " + yaml_list(std::array{q.x(), q.y(), q.z(), q.w()});
  }
  return text + "}";
}

std::string absolute(const std::string& path) {
  std::error_code failure;
  const std::filesystem::path whole = std::filesystem::absolute(path, failure).lexically_normal();
  return failure ? path : whole.string();
}

/// Relative to a data folder when it lies in one, so that the file can move to another machine.
std::string portable(const std::string& path) {
  const std::string whole = absolute(path);
  const char* data = std::getenv("MAMO_DATA_DIR");
  for (const std::string& folder : {std::string(data ? data : ""), std::string(MAMO_SOURCE_DATA_DIR),
                                    std::string(MAMO_INSTALL_DATA_DIR)}) {
    if (folder.empty()) continue;
    const std::string prefix = absolute(folder) + "/";
    if (whole.starts_with(prefix)) return whole.substr(prefix.size());
  }
  return whole;
}

std::string shape_text(const Shape& shape) {
  if (const Box* box = std::get_if<Box>(&shape)) return "{box: {size: " + vector_text(box->size) + "}}";
  if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    return "{cylinder: {radius: " + yaml_number(c->radius) + ", length: " + yaml_number(c->length) + "}}";
  if (const Sphere* s = std::get_if<Sphere>(&shape)) return "{sphere: {radius: " + yaml_number(s->radius) + "}}";
  const ConvexHull& hull = *std::get<Mesh>(shape).hull;
  return "{mesh: {file: " + yaml_string(portable(hull.source)) + ", scale: " + vector_text(hull.scale) + "}}";
}

std::string joints_text(const Robot& robot, const Eigen::VectorXd& q) {
  std::string text;
  for (int i = 0; i < robot.dof(); ++i)
    text += (i ? ", " : "{") + yaml_string(robot.joint(i).name) + ": " + yaml_number(q[i]);
  return text + "}";
}

class Writer {
 public:
  explicit Writer(const Problem& problem) : problem_(problem) {}

  Result<std::string> run() {
    for (const Object& object : problem_.scene.objects)
      for (const PlacedShape& s : object.shapes)
        if (const Mesh* mesh = std::get_if<Mesh>(&s.shape); mesh && mesh->hull->source.empty())
          return Error{"object " + in_quotes(object.id) + " has a mesh that came from no file and cannot be written"};
    if (problem_.robot_files.urdf.empty()) return Error{"the robot came from no URDF file and cannot be written"};
    text_ = "format: mamo-problem/1\n";
    write_notes();
    write_robot();
    text_ += "task: " + task_text() + "\n";
    text_ += "constraints: {profile: " + std::string(mamo::to_string(problem_.profile)) + "}\n";
    write_physics();
    text_ += problem_.scene.objects.empty() ? "objects: []\n" : "objects:\n";
    for (const Object& object : problem_.scene.objects) write_object(object);
    text_ += "end: true\n";
    return text_;
  }

 private:
  void write_notes() {
    if (problem_.generated.empty()) return;
    text_ += "generated:\n";
    for (const auto& [key, value] : problem_.generated)
      text_ += "  " + yaml_string(key) + ": " + (parse_number(value) ? value : yaml_string(value)) + "\n";
  }

  void write_robot() {
    const Robot& robot = problem_.robot;
    const RobotFiles& files = problem_.robot_files;
    const RobotModel& model = *robot.model;
    text_ += "robot:\n  urdf: " + yaml_string(portable(files.urdf)) + "\n";
    if (!files.srdf.empty()) text_ += "  srdf: " + yaml_string(portable(files.srdf)) + "\n";
    text_ += "  base: " + yaml_string(model.links[robot.group.base.index()].name) + "\n";
    text_ += "  tip: " + yaml_string(model.links[robot.group.tip.index()].name) + "\n  joints: [";
    for (int i = 0; i < robot.dof(); ++i) text_ += (i ? ", " : "") + yaml_string(robot.joint(i).name);
    text_ += "]\n  start: " + joints_text(robot, problem_.q_start) + "\n";
    write_fixed();
    if (!robot.X_WB.isApprox(Eigen::Isometry3d::Identity(), 0)) text_ += "  pose: " + pose_text(robot.X_WB) + "\n";
    if (!files.package_path.empty()) {
      text_ += "  package_path:\n";
      for (const auto& [name, folder] : files.package_path)
        text_ += "    " + yaml_string(name) + ": " + yaml_string(absolute(folder)) + "\n";
    }
    text_ += "  speed_scale: " + yaml_number(robot.speed_scale) + "\n";
  }

  /// The joints outside the group that do not stand where they stand without being told.
  void write_fixed() {
    const Robot& robot = problem_.robot;
    std::string fixed;
    for (int v = 0; v < robot.model->variables; ++v) {
      const JointId id = robot.model->variable_joint[static_cast<std::size_t>(v)];
      const Joint& joint = robot.model->joints[id.index()];
      const bool in_group = std::find(robot.group.joints.begin(), robot.group.joints.end(), id) != robot.group.joints.end();
      if (in_group || robot.posture[v] == std::clamp(0.0, joint.lower, joint.upper)) continue;
      fixed += (fixed.empty() ? "{" : ", ") + yaml_string(joint.name) + ": " + yaml_number(robot.posture[v]);
    }
    if (!fixed.empty()) text_ += "  fixed: " + fixed + "}\n";
  }

  std::string task_text() const {
    if (const ReachPose* reach = std::get_if<ReachPose>(&problem_.task)) {
      std::string text = "{kind: reach, pose: " + pose_text(reach->X_WT) +
                         ", tolerance: {position: " + yaml_number(reach->position_tolerance) +
                         ", angle: " + yaml_number(reach->angle_tolerance) + "}";
      if (reach->target.valid()) text += ", target: " + yaml_string(problem_.scene[reach->target].id);
      return text + "}";
    }
    if (const ReachJoints* reach = std::get_if<ReachJoints>(&problem_.task))
      return "{kind: reach, joints: " + joints_text(problem_.robot, reach->q) +
             ", tolerance: " + yaml_number(reach->tolerance) + "}";
    const Retrieve& retrieve = std::get<Retrieve>(problem_.task);
    const bool at_start = retrieve.home == problem_.q_start;
    return "{kind: retrieve, object: " + yaml_string(problem_.scene[retrieve.object].id) +
           ", pregrasp: " + pose_text(retrieve.X_WT_pregrasp) +
           ", home: " + (at_start ? "start" : joints_text(problem_.robot, retrieve.home)) +
           ", tolerance: " + yaml_number(retrieve.home_tolerance) + "}";
  }

  void write_physics() {
    const PhysicsSettings& p = problem_.scene.physics;
    const PhysicsSettings usual;
    std::string text;
    const auto add = [&](const char* key, double value, double standard) {
      if (value != standard) text += (text.empty() ? "{" : ", ") + std::string(key) + ": " + yaml_number(value);
    };
    add("step", p.step, usual.step);
    add("iterations", p.iterations, usual.iterations);
    add("robot_friction", p.robot_friction, usual.robot_friction);
    add("settle_time", p.settle_time, usual.settle_time);
    if (!text.empty()) text_ += "physics: " + text + "}\n";
  }

  void write_object(const Object& object) {
    text_ += "  - {id: " + yaml_string(object.id) + ", ";
    const bool one = object.shapes.size() == 1 && object.shapes[0].X_BS.matrix() == Eigen::Matrix4d::Identity();
    if (one) {
      text_ += "shape: " + shape_text(object.shapes[0].shape);
    } else {
      text_ += "shapes: [";
      for (std::size_t i = 0; i < object.shapes.size(); ++i)
        text_ += (i ? ", {shape: " : "{shape: ") + shape_text(object.shapes[i].shape) +
                 ", pose: " + pose_text(object.shapes[i].X_BS) + "}";
      text_ += "]";
    }
    text_ += ",\n     pose: " + pose_text(object.X_WO) + ",\n     ";
    if (object.mass > 0) text_ += "mass: " + yaml_number(object.mass) + ", ";
    text_ += "friction: " + yaml_number(object.friction) + ", ";
    text_ += object.fixture() ? "fixture: true" : object.movable() ? "movable: true" : "movable: false";
    write_constraints(object);
    text_ += "}\n";
  }

  void write_constraints(const Object& object) {
    const InteractionConstraints& c = object.constraints;
    const InteractionConstraints usual = default_constraints(problem_.profile, object.kind);
    if (object.fixture()) {
      text_ += ", touch: " + std::string(to_string(c.touch));
      return;
    }
    std::string own;
    const auto add = [&](const char* key, const std::string& value) {
      own += (own.empty() ? ", constraints: {" : ", ") + std::string(key) + ": " + value;
    };
    if (c.max_tilt != usual.max_tilt) add("max_tilt", yaml_number(c.max_tilt));
    if (c.max_speed != usual.max_speed) add("max_speed", yaml_number(c.max_speed));
    if (c.may_leave_support != usual.may_leave_support) add("may_leave_support", c.may_leave_support ? "true" : "false");
    if (c.max_displacement != usual.max_displacement) add("max_displacement", yaml_number(c.max_displacement));
    if (c.touch != usual.touch) add("touch", std::string(to_string(c.touch)));
    if (!own.empty()) text_ += own + "}";
  }

  const Problem& problem_;
  std::string text_;
};

}  // namespace

Result<std::string> to_native_yaml(const Problem& problem) { return Writer(problem).run(); }

}  // namespace mamo::io
