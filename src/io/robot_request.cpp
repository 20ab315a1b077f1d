#include "io/robot_request.hpp"

#include <filesystem>

#include "io/text.hpp"

#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

/// JOINT: value (rad or m), finite.
std::map<std::string, double> read_joint_map(const YamlValue& value, const std::string& what, Complaints& complaints) {
  std::map<std::string, double> joints;
  if (!value.is_map()) {
    complaints.add(value, what + " must be a map from joint to value");
    return joints;
  }
  for (const YamlMember& m : value.members)
    joints[m.key] = read_number(m.value, in_quotes(m.key) + " of " + what, kAnyNumber, complaints);
  return joints;
}

/// make_robot's messages name no place; the word in quotes tells which entry of the file is meant.
const YamlValue& place_of(const std::string& message, const YamlValue& node) {
  for (const char* key : {"start", "fixed"}) {
    const YamlValue* map = node.find(key);
    if (!map) continue;
    for (const YamlMember& m : map->members)
      if (message.find("'" + m.key + "'") != std::string::npos) return m.value;
  }
  for (const char* key : {"tip", "base", "group", "speed_scale"}) {
    const YamlValue* scalar = node.find(key);
    if (scalar && message.find(scalar->scalar) != std::string::npos) return *scalar;
  }
  if (const YamlValue* joints = node.find("joints"))
    for (const YamlValue& item : joints->items)
      if (message.find("'" + item.scalar + "'") != std::string::npos) return item;
  return node;
}

class Installer {
 public:
  Installer(RobotRequest request, const LoadOptions& options, const YamlValue* node, Problem& problem,
            Complaints& complaints)
      : request_(std::move(request)), options_(options), node_(node), problem_(problem), complaints_(complaints) {}

  void run() {
    replaced_ = !options_.robot.empty();
    apply_options();
    if (!load_files()) return;
    if (replaced_) keep_what_fits();
    if (!request_.start_state.empty() && !take_state(request_.start_state)) return;
    Result<Robot> robot = make_robot(description_, request_.spec);
    if (!robot) return complain(robot.error().message);
    problem_.robot = std::move(*robot);
    problem_.q_start = problem_.robot.group_part(problem_.robot.posture);
    check_start();
    if (!request_.srdf.empty()) problem_.robot_files.disabled = disabled_links(srdf_, *description_.model);
  }

 private:
  void complain(const std::string& message) {
    if (node_) return complaints_.add(replaced_ ? *node_ : place_of(message, *node_), "robot: " + message);
    complaints_.add(Error{one_line(complaints_.file()) + ": robot: " + message});
  }

  void apply_options() {
    for (const auto& [name, folder] : options_.package_path) request_.package_path[name] = folder;
    if (!options_.srdf.empty()) request_.srdf = options_.srdf;
    if (replaced_) {
      request_.urdf = options_.robot;
      if (options_.srdf.empty()) request_.srdf.clear();
    }
    GroupSpec& spec = request_.spec;
    if (!options_.group.empty() || !options_.tip.empty()) {
      spec.joints.clear();
      spec.group = options_.group;
      spec.base = options_.base;
      spec.tip = options_.tip;
    } else if (!options_.base.empty()) {
      spec.base = options_.base;
    }
  }

  /// Files of the command line are meant from here, those of the problem from its folder.
  Result<std::string> locate(const std::string& name, bool from_command_line) const {
    std::error_code failure;
    if (from_command_line && std::filesystem::exists(name, failure)) return name;
    return find_data_file(name, from_command_line ? std::string{} : problem_.path);
  }

  bool load_files() {
    RobotFiles& files = problem_.robot_files;
    files.package_path = request_.package_path;
    const Result<std::string> urdf = locate(request_.urdf, replaced_);
    if (!urdf) return complain(urdf.error().message), false;
    files.urdf = *urdf;
    Result<RobotDescription> description = load_urdf(*urdf, request_.package_path);
    if (!description) return complaints_.add(description.error()), false;
    description_ = std::move(*description);
    problem_.warnings.insert(problem_.warnings.end(), description_.warnings.begin(), description_.warnings.end());
    if (request_.srdf.empty()) return true;
    const Result<std::string> path = locate(request_.srdf, !options_.srdf.empty());
    if (!path) return complain(path.error().message), false;
    files.srdf = *path;
    Result<Srdf> srdf = load_srdf(*path, *description_.model);
    if (!srdf) return complaints_.add(srdf.error()), false;
    srdf_ = std::move(*srdf);
    request_.spec.srdf = &srdf_;
    return true;
  }

  /// Values of joints that the replacing robot lacks are dropped, others moved into its limits. If nothing is left
  /// the SRDF's "ready" or "home" is taken, else zeros.
  void keep_what_fits() {
    const RobotModel& model = *description_.model;
    int misfits = 0;
    std::size_t kept = 0;
    for (auto* values : {&request_.spec.start, &request_.spec.fixed}) {
      misfits += static_cast<int>(std::erase_if(*values, [&](const auto& entry) {
        const JointId id = model.find_joint(entry.first);
        return !id.valid() || model.joints[id.index()].variable < 0;
      }));
      for (auto& [name, value] : *values) {
        const Joint& joint = model.joints[model.find_joint(name).index()];
        const double inside = std::clamp(value, joint.lower, joint.upper);
        misfits += inside != value;
        value = inside;
        ++kept;
      }
    }
    if (misfits > 0)
      complaints_.warn(node_ ? node_->line : 0, node_ ? node_->column : 0,
                       std::to_string(misfits) + " joint values of the file do not fit the robot " +
                           one_line(request_.urdf) + " (left out, or moved into its limits)");
    if (!request_.start_state.empty() && !srdf_.states.count(request_.start_state)) request_.start_state.clear();
    if (kept > 0 || !request_.start_state.empty()) return;
    for (const char* name : {"ready", "home", "default"})
      if (request_.start_state.empty() && srdf_.states.count(name)) request_.start_state = name;
  }

  bool take_state(const std::string& name) {
    const auto state = srdf_.states.find(name);
    if (state == srdf_.states.end()) {
      std::vector<std::string> known;
      for (const auto& entry : srdf_.states) known.push_back(entry.first);
      complain("unknown group state '" + name + "'" +
               (known.empty() ? " (the SRDF has none, or no 'srdf' is given)"
                              : ", the nearest is '" + nearest_name(name, known) + "'"));
      return false;
    }
    for (const auto& [joint, value] : state->second)
      if (!request_.spec.fixed.count(joint)) request_.spec.start[joint] = value;
    return true;
  }

  void check_start() {
    std::string missing;
    for (int i = 0; i < problem_.robot.dof(); ++i) {
      const std::string& name = problem_.robot.joint(i).name;
      if (!request_.spec.start.count(name)) missing += (missing.empty() ? "'" : ", '") + name + "'";
    }
    if (missing.empty()) return;
    if (replaced_)
      complaints_.warn(0, 0, "the robot's start gives no value for " + missing + ": taken as 0, moved into the limits");
    else if (const YamlValue* start = node_ ? node_->find("start") : nullptr)
      complaints_.add(*start, "start of robot misses the joint " + missing + " of the planning group");
    else
      complain("start misses the joint " + missing + " of the planning group");
  }

  RobotRequest request_;
  const LoadOptions& options_;
  const YamlValue* node_;
  Problem& problem_;
  Complaints& complaints_;
  bool replaced_ = false;
  RobotDescription description_;
  Srdf srdf_;
};

}  // namespace

RobotRequest read_robot(const YamlValue& value, Complaints& complaints) {
  RobotRequest request;
  StrictMap map(
      value, "robot",
      {"urdf", "srdf", "base", "tip", "joints", "group", "start", "fixed", "pose", "package_path", "speed_scale"},
      complaints);
  request.urdf = map.need_text("urdf");
  request.srdf = map.text("srdf");
  request.spec.base = map.text("base");
  request.spec.tip = map.text("tip");
  request.spec.group = map.text("group");
  if (const YamlValue* joints = map.find("joints")) {
    if (!joints->is_list() || joints->items.empty()) complaints.add(*joints, "joints of robot must be a list of names");
    for (const YamlValue& joint : joints->items)
      request.spec.joints.push_back(read_text(joint, "a joint of robot", complaints));
  }
  if (map.has("joints") && map.has("group")) map.complain("robot gives both 'joints' and 'group'");
  const YamlValue& start = map.need("start");
  if (start.is_scalar())
    request.start_state = start.scalar;
  else
    request.spec.start = read_joint_map(start, "start of robot", complaints);
  if (const YamlValue* fixed = map.find("fixed"))
    request.spec.fixed = read_joint_map(*fixed, "fixed of robot", complaints);
  if (const YamlValue* pose = map.find("pose")) request.spec.X_WB = read_pose(*pose, "pose of robot", complaints);
  if (const YamlValue* packages = map.find("package_path")) {
    if (!packages->is_map()) complaints.add(*packages, "package_path of robot must be a map from package to folder");
    for (const YamlMember& m : packages->members)
      request.package_path[m.key] = read_text(m.value, "package_path " + in_quotes(m.key), complaints);
  }
  request.spec.speed_scale =
      map.number("speed_scale", request.spec.speed_scale, {1e-3, 1, false, "above 0 (0.001) and at most 1"});
  return request;
}

void install_robot(RobotRequest request, const LoadOptions& options, const YamlValue* node, Problem& problem,
                   Complaints& complaints) {
  Installer(std::move(request), options, node, problem, complaints).run();
}

}  // namespace mamo::io
