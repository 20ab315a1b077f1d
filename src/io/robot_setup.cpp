#include "mamo/io/robot_setup.hpp"

#include <cstdio>

#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

class Setup {
 public:
  Setup(const RobotDescription& description, const GroupSpec& spec) : model_(*description.model), spec_(spec) {
    robot_.model = description.model;
  }

  Result<Robot> run() {
    choose_group();
    if (!error_) fill_posture();
    if (!error_ && !(spec_.speed_scale > 0 && spec_.speed_scale <= 1))
      fail("speed_scale is " + number(spec_.speed_scale) + ", expected a number above 0 and at most 1");
    if (!error_ && !spec_.X_WB.matrix().allFinite()) fail("the base pose is not finite");
    if (error_) return *error_;
    robot_.X_WB = spec_.X_WB;
    robot_.speed_scale = spec_.speed_scale;
    return std::move(robot_);
  }

 private:
  void fail(const std::string& message) {
    if (!error_) error_ = Error{message};
  }

  LinkId link(const std::string& name) {
    const LinkId id = model_.find_link(name);
    if (id.valid()) return id;
    std::vector<std::string> known;
    for (const Link& l : model_.links) known.push_back(l.name);
    fail("unknown link '" + name + "'; nearest is '" + nearest_name(name, known) + "'");
    return id;
  }

  /// A joint that moves by itself.
  JointId moving_joint(const std::string& name) {
    const JointId id = model_.find_joint(name);
    if (!id.valid()) {
      std::vector<std::string> known;
      for (JointId j : model_.variable_joint) known.push_back(model_.joints[j.index()].name);
      fail("unknown joint '" + name + "'; nearest is '" + nearest_name(name, known) + "'");
      return {};
    }
    const Joint& joint = model_.joints[id.index()];
    if (joint.type == JointType::fixed) return fail("joint '" + name + "' is fixed"), JointId{};
    if (joint.mimic) {
      fail("joint '" + name + "' mimics '" + model_.joints[joint.mimic->joint.index()].name + "': name that one");
      return {};
    }
    return id;
  }

  void choose_group() {
    std::string base = spec_.base, tip = spec_.tip;
    std::vector<std::string> names = spec_.joints;
    bool whole_chain = names.empty();
    if (names.empty() && !spec_.group.empty()) {
      const SrdfGroup* group = find_group();
      if (!group) return;
      whole_chain = false;
      names = group->joints;
      if (base.empty()) base = group->base;
      if (tip.empty()) tip = group->tip;
      if (names.empty()) return fail("SRDF group '" + group->name + "' has no joint that moves");
      if (tip.empty()) tip = model_.links[model_.joints[model_.find_joint(names.back()).index()].child.index()].name;
    }
    if (tip.empty()) return fail("the robot has no tip link, expected 'tip' or an SRDF group with a chain");
    robot_.group.base = base.empty() ? LinkId{0} : link(base);
    robot_.group.tip = link(tip);
    if (error_) return;
    if (whole_chain)
      take_chain();
    else
      take_joints(names);
  }

  const SrdfGroup* find_group() {
    if (!spec_.srdf) return fail("group '" + spec_.group + "' needs an SRDF file"), nullptr;
    std::vector<std::string> known;
    for (const SrdfGroup& g : spec_.srdf->groups) {
      if (g.name == spec_.group) return &g;
      known.push_back(g.name);
    }
    fail(known.empty() ? "the SRDF file has no groups"
                       : "unknown group '" + spec_.group + "'; nearest is '" + nearest_name(spec_.group, known) + "'");
    return nullptr;
  }

  /// Joints from the root to a link.
  std::vector<JointId> ancestors(LinkId at) const {
    std::vector<JointId> joints;
    while (model_.links[at.index()].parent_joint.valid()) {
      joints.push_back(model_.links[at.index()].parent_joint);
      at = model_.joints[joints.back().index()].parent;
    }
    std::reverse(joints.begin(), joints.end());
    return joints;
  }
  const std::string& name_of(LinkId id) const { return model_.links[id.index()].name; }

  void take_chain() {
    bool below_base = robot_.group.base == LinkId{0};
    for (JointId id : ancestors(robot_.group.tip)) {
      const Joint& joint = model_.joints[id.index()];
      if (joint.parent == robot_.group.base) below_base = true;
      if (below_base && joint.variable >= 0) robot_.group.joints.push_back(id);
    }
    if (!below_base)
      return fail("link '" + name_of(robot_.group.base) + "' is not above link '" + name_of(robot_.group.tip) +
                  "' in the robot");
    if (robot_.group.joints.empty())
      fail("no joint moves between '" + name_of(robot_.group.base) + "' and '" + name_of(robot_.group.tip) + "'");
  }

  void take_joints(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const JointId id = moving_joint(name);
      if (!id.valid()) return;
      if (std::find(robot_.group.joints.begin(), robot_.group.joints.end(), id) != robot_.group.joints.end())
        return fail("joint '" + name + "' is named twice");
      robot_.group.joints.push_back(id);
    }
    std::sort(robot_.group.joints.begin(), robot_.group.joints.end());
    if (!robot_.moving_links()[robot_.group.tip.index()])
      fail("no joint of the group moves the tip link '" + name_of(robot_.group.tip) + "'");
  }

  void fill_posture() {
    robot_.posture.resize(model_.variables);
    for (int v = 0; v < model_.variables; ++v) {
      const Joint& joint = model_.joints[model_.variable_joint[static_cast<std::size_t>(v)].index()];
      robot_.posture[v] = std::clamp(0.0, joint.lower, joint.upper);
    }
    for (const auto& [name, value] : spec_.fixed) {
      const JointId id = set(name, value);
      const auto& group = robot_.group.joints;
      if (id.valid() && std::find(group.begin(), group.end(), id) != group.end())
        return fail("joint '" + name + "' is fixed at a value, but belongs to the planning group");
      if (spec_.start.count(name)) return fail("joint '" + name + "' has both a start and a fixed value");
    }
    for (const auto& [name, value] : spec_.start) set(name, value);
  }

  JointId set(const std::string& name, double value) {
    const JointId id = moving_joint(name);
    if (!id.valid()) return id;
    const Joint& joint = model_.joints[id.index()];
    if (!(value >= joint.lower - kSlack && value <= joint.upper + kSlack && std::isfinite(value))) {
      fail("joint '" + name + "' at " + number(value) + " is outside its limits " + number(joint.lower) + " to " +
           number(joint.upper));
      return {};
    }
    robot_.posture[joint.variable] = std::clamp(value, joint.lower, joint.upper);
    return id;
  }

  static constexpr double kSlack = 1e-6;  // rad or m: values printed with six decimals stay inside
  const RobotModel& model_;
  const GroupSpec& spec_;
  Robot robot_;
  std::optional<Error> error_;
};

}  // namespace

Result<Robot> make_robot(const RobotDescription& description, const GroupSpec& spec) {
  return Setup(description, spec).run();
}

std::vector<std::pair<LinkId, LinkId>> disabled_links(const Srdf& srdf, const RobotModel& model) {
  std::vector<std::pair<LinkId, LinkId>> pairs;
  for (const auto& [first, second] : srdf.disabled) {
    const LinkId a = model.find_link(first), b = model.find_link(second);
    if (a.valid() && b.valid() && a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
  }
  return pairs;
}

}  // namespace mamo::io
