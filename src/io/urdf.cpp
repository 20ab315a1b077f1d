// URDF to RobotModel: urdfdom parses, this file checks what it left out and resolves mimic chains and meshes.
#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>
#include <set>
#include <tuple>

#include "io/resource_path.hpp"
#include "io/urdf_check.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/mesh.hpp"

namespace mamo::io {
namespace {

constexpr double kUsualGrowth = 1e-3;  // m: hulls grown by more are worth a warning

/// Collects what urdfdom says. console_bridge has one handler per process, hence the lock around its use.
class MessageCollector : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) messages.push_back(text);
  }
  std::vector<std::string> messages;
};

std::pair<urdf::ModelInterfaceSharedPtr, std::vector<std::string>> parse_quietly(const std::string& text) {
  static std::mutex handler_in_use;
  const std::lock_guard lock(handler_in_use);
  MessageCollector collector;
  console_bridge::OutputHandler* const before = console_bridge::getOutputHandler();
  console_bridge::useOutputHandler(&collector);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& e) {
    collector.messages.push_back(e.what());
  }
  console_bridge::useOutputHandler(before);
  return {model, collector.messages};
}

std::string one_line(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& m : messages) text += (text.empty() ? "" : "; ") + m;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text.empty() ? "no robot in it" : text.substr(0, 500);
}

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  const urdf::Rotation& r = pose.rotation;
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  return X;
}

Eigen::Vector3d vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

class Builder {
 public:
  Builder(const std::string& path, const urdf::ModelInterface& urdf, UrdfLines lines,
          const std::map<std::string, std::string>& package_path)
      : path_(path), urdf_(urdf), lines_(std::move(lines)), package_path_(package_path) {}

  Result<RobotDescription> build() {
    model_->name = urdf_.getName();
    model_->source = path_;
    add_tree();
    for (Joint& joint : model_->joints)
      if (!error_) resolve_mimic(joint);
    for (std::size_t i = 0; i < model_->joints.size(); ++i) {
      Joint& joint = model_->joints[i];
      if (joint.type == JointType::fixed || joint.mimic) continue;
      joint.variable = model_->variables++;
      model_->variable_joint.push_back(JointId(i));
    }
    for (Link& link : model_->links)
      if (!error_) add_geometry(link);
    if (error_) return *error_;
    return RobotDescription{model_, std::move(warnings_)};
  }

 private:
  std::string place(const std::map<std::string, int>& lines, const std::string& name) const {
    const auto line = lines.find(name);
    return path_ + (line == lines.end() ? "" : ":" + std::to_string(line->second)) + ": ";
  }
  void fail(const std::string& message) {
    if (!error_) error_ = Error{message};
  }

  /// Links in depth-first order from the root, children in urdfdom's order (by joint name).
  void add_tree() {
    struct Waiting {
      urdf::LinkConstSharedPtr link;
      LinkId parent;
    };
    std::vector<Waiting> stack{{urdf_.getRoot(), LinkId{-1}}};
    while (!stack.empty()) {
      const Waiting next = stack.back();
      stack.pop_back();
      const LinkId id(model_->links.size());
      Link link;
      link.name = next.link->name;
      if (next.link->inertial) link.mass = std::max(0.0, next.link->inertial->mass);
      if (next.parent.valid()) {
        link.parent_joint = JointId(model_->joints.size());
        model_->joints.push_back(joint_of(*next.link->parent_joint, next.parent, id));
      }
      model_->links.push_back(std::move(link));
      for (auto child = next.link->child_links.rbegin(); child != next.link->child_links.rend(); ++child)
        stack.push_back({*child, id});
    }
  }

  Joint joint_of(const urdf::Joint& from, LinkId parent, LinkId child) {
    Joint joint;
    joint.name = from.name;
    joint.parent = parent;
    joint.child = child;
    joint.X_PJ = pose_of(from.parent_to_joint_origin_transform);
    switch (from.type) {
      case urdf::Joint::REVOLUTE:
        joint.type = JointType::revolute;
        break;
      case urdf::Joint::CONTINUOUS:
        joint.type = JointType::continuous;
        break;
      case urdf::Joint::PRISMATIC:
        joint.type = JointType::prismatic;
        break;
      default:
        joint.type = JointType::fixed;
        break;  // check_urdf refused floating and planar
    }
    if (joint.type == JointType::fixed) return joint;
    joint.axis = vector_of(from.axis).normalized();
    if (from.limits && joint.type != JointType::continuous) {
      joint.lower = from.limits->lower;
      joint.upper = from.limits->upper;
    }
    if (from.limits && from.limits->velocity > 0)
      joint.max_velocity = from.limits->velocity;
    else
      warnings_.push_back(place(lines_.joints, joint.name) + "joint '" + joint.name +
                          "' has no velocity limit; 1 is used");
    return joint;
  }

  /// Follows the chain of mimicked joints to the one that moves by itself.
  void resolve_mimic(Joint& joint) {
    if (joint.type == JointType::fixed || !urdf_.getJoint(joint.name)->mimic) return;
    Mimic total;
    std::vector<std::string> chain{joint.name};
    while (true) {
      const urdf::JointMimic& step = *urdf_.getJoint(chain.back())->mimic;
      total.offset += total.multiplier * step.offset;
      total.multiplier *= step.multiplier;
      const bool circle = std::find(chain.begin(), chain.end(), step.joint_name) != chain.end();
      chain.push_back(step.joint_name);
      if (circle) {
        std::string names;
        for (const std::string& name : chain) names += (names.empty() ? "" : " -> ") + name;
        return fail(place(lines_.joints, joint.name) + "joints mimic one another in a circle: " + names);
      }
      const urdf::JointConstSharedPtr target = urdf_.getJoint(step.joint_name);
      if (target->type == urdf::Joint::FIXED)
        return fail(place(lines_.joints, joint.name) + "joint '" + joint.name + "' mimics the fixed joint '" +
                    step.joint_name + "'");
      if (!target->mimic) break;
    }
    total.joint = model_->find_joint(chain.back());
    joint.mimic = total;
  }

  void add_geometry(Link& link) {
    const urdf::LinkConstSharedPtr from = urdf_.getLink(link.name);
    for (const auto& collision : from->collision_array) {
      if (!collision || !collision->geometry) continue;
      std::optional<Shape> shape = primitive_of(*collision->geometry);
      if (!shape) shape = hull_of(link.name, static_cast<const urdf::Mesh&>(*collision->geometry));
      if (!shape) return;
      link.collision.push_back({std::move(*shape), pose_of(collision->origin)});
    }
    for (const auto& visual : from->visual_array)
      if (visual && visual->geometry) add_visual(link, *visual);
  }

  static std::optional<Shape> primitive_of(const urdf::Geometry& geometry) {
    switch (geometry.type) {
      case urdf::Geometry::BOX:
        return Box{vector_of(static_cast<const urdf::Box&>(geometry).dim)};
      case urdf::Geometry::SPHERE:
        return Sphere{static_cast<const urdf::Sphere&>(geometry).radius};
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        return Cylinder{cylinder.radius, cylinder.length};
      }
      default:
        return std::nullopt;
    }
  }

  std::optional<Shape> hull_of(const std::string& link, const urdf::Mesh& mesh) {
    const auto key = std::tuple(mesh.filename, mesh.scale.x, mesh.scale.y, mesh.scale.z);
    if (const auto known = hulls_.find(key); known != hulls_.end()) return Mesh{known->second};
    const std::string prefix = place(lines_.links, link) + "link '" + link + "': collision mesh ";
    Result<std::string> file = resolve_resource(mesh.filename, path_, package_path_);
    if (!file) return fail(prefix + file.error().message), std::nullopt;
    Result<LoadedHull> hull = load_hull(*file, vector_of(mesh.scale));
    if (!hull) return fail(prefix + hull.error().message), std::nullopt;
    if (hull->growth > kUsualGrowth)
      warnings_.push_back(prefix + *file + " was simplified; its hull grew by up to " +
                          std::to_string(hull->growth * 1000).substr(0, 4) + " mm");
    hulls_.emplace(key, hull->hull);
    return Mesh{hull->hull};
  }

  void add_visual(Link& link, const urdf::Visual& from) {
    VisualGeometry visual;
    visual.X_LV = pose_of(from.origin);
    visual.shape = primitive_of(*from.geometry);
    if (from.material) {
      const urdf::Color& c = from.material->color;
      visual.rgba = Eigen::Vector4d(c.r, c.g, c.b, c.a);
    }
    if (!visual.shape) {
      const auto& mesh = static_cast<const urdf::Mesh&>(*from.geometry);
      visual.scale = vector_of(mesh.scale);
      Result<std::string> file = resolve_resource(mesh.filename, path_, package_path_);
      if (file)
        visual.mesh_path = *file;
      else if (missing_visuals_.insert(mesh.filename).second)
        warnings_.push_back(place(lines_.links, link.name) + "link '" + link.name + "': visual mesh " +
                            file.error().message);
    }
    link.visual.push_back(std::move(visual));
  }

  const std::string& path_;
  const urdf::ModelInterface& urdf_;
  const UrdfLines lines_;
  const std::map<std::string, std::string>& package_path_;
  std::shared_ptr<RobotModel> model_ = std::make_shared<RobotModel>();  // shared: handed out as the description
  std::map<std::tuple<std::string, double, double, double>, std::shared_ptr<const ConvexHull>> hulls_;
  std::set<std::string> missing_visuals_;
  std::vector<std::string> warnings_;
  std::optional<Error> error_;
};

}  // namespace

Result<RobotDescription> load_urdf(const std::string& path, const std::map<std::string, std::string>& package_path) {
  Result<XmlFile> file = load_xml(path, "robot");
  if (!file) return file.error();
  Result<UrdfLines> lines = check_urdf(*file);
  if (!lines) return lines.error();
  const auto [urdf, messages] = parse_quietly(file->text);
  if (!urdf || !urdf->getRoot()) return Error{path + ": not a valid URDF: " + one_line(messages)};
  Result<RobotDescription> description = Builder(path, *urdf, std::move(*lines), package_path).build();
  if (description)
    for (const std::string& m : messages) description->warnings.push_back(path + ": " + one_line({m}));
  return description;
}

}  // namespace mamo::io
