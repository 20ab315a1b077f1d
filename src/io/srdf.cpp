// SRDF (FORMATS.md section 4): groups, named states and disabled link pairs, checked against the robot.
#include <set>

#include "io/xml_file.hpp"

#include "mamo/io/load.hpp"
#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

using tinyxml2::XMLElement;

class SrdfReader {
 public:
  SrdfReader(const XmlFile& file, const RobotModel& model) : file_(file), model_(model) {}

  Result<Srdf> read() {
    for (const XMLElement* e = file_.root->FirstChildElement("group"); e; e = e->NextSiblingElement("group")) {
      const std::string name = attribute(e, "name");
      if (name.empty()) fail(e, "<group> without a name");
      if (!groups_.emplace(name, e).second) fail(e, "group '" + name + "' is defined twice");
      order_.push_back(name);
    }
    for (const std::string& name : order_) {
      if (error_) break;
      SrdfGroup group;
      group.name = name;
      std::set<JointId> joints;
      std::vector<std::string> path;
      std::set<std::string> finished;
      collect(groups_[name], group, joints, path, finished);
      for (JointId j : joints) group.joints.push_back(model_.joints[j.index()].name);
      srdf_.groups.push_back(std::move(group));
    }
    for (const XMLElement* e = file_.root->FirstChildElement(); e && !error_; e = e->NextSiblingElement()) {
      const std::string kind = e->Name();
      if (kind == "group_state") read_state(e);
      if (kind == "disable_collisions") read_disabled(e);
      if (kind == "disable_default_collisions") disable_default(e);
    }
    for (const XMLElement* e = file_.root->FirstChildElement("enable_collisions"); e && !error_;
         e = e->NextSiblingElement("enable_collisions"))
      if (const auto pair = link_pair(e)) disabled_.erase(*pair);
    if (error_) return *error_;
    for (const auto& [a, b] : disabled_) srdf_.disabled.emplace_back(name_of(a), name_of(b));
    return std::move(srdf_);
  }

 private:
  void fail(const XMLElement* where, const std::string& message) {
    if (!error_) error_ = file_.error_at(where, message);
  }
  const std::string& name_of(LinkId id) const { return model_.links[id.index()].name; }

  LinkId link(const XMLElement* e, const char* key) {
    const std::string name = attribute(e, key);
    const LinkId id = model_.find_link(name);
    if (id.valid()) return id;
    std::vector<std::string> known;
    for (const Link& l : model_.links) known.push_back(l.name);
    fail(e, "unknown link '" + name + "'; nearest is '" + nearest_name(name, known) + "'");
    return id;
  }
  JointId joint(const XMLElement* e) {
    const std::string name = attribute(e, "name");
    const JointId id = model_.find_joint(name);
    if (id.valid()) return id;
    std::vector<std::string> known;
    for (const Joint& j : model_.joints) known.push_back(j.name);
    fail(e, "unknown joint '" + name + "'; nearest is '" + nearest_name(name, known) + "'");
    return id;
  }

  /// A planning joint moves by itself.
  void add(JointId id, std::set<JointId>& joints) const {
    const Joint& j = model_.joints[id.index()];
    if (j.variable >= 0) joints.insert(id);
  }

  /// Joints of a group and its subgroups. `path`: the groups being collected, to find circles; `finished`: those
  /// that are in already (a file may name one group many times at many levels).
  void collect(const XMLElement* group, SrdfGroup& out, std::set<JointId>& joints, std::vector<std::string>& path,
               std::set<std::string>& finished) {
    path.push_back(attribute(group, "name"));
    for (const XMLElement* e = group->FirstChildElement(); e && !error_; e = e->NextSiblingElement()) {
      const std::string kind = e->Name();
      if (kind == "chain") {
        add_chain(e, out, joints, path.size() == 1);
      } else if (kind == "joint") {
        if (const JointId id = joint(e); id.valid()) add(id, joints);
      } else if (kind == "link") {
        const LinkId id = link(e, "name");
        if (id.valid() && model_.links[id.index()].parent_joint.valid())
          add(model_.links[id.index()].parent_joint, joints);
      } else if (kind == "group") {
        const std::string name = attribute(e, "name");
        const auto sub = groups_.find(name);
        if (sub == groups_.end())
          return fail(e, "group '" + path.front() + "' contains the unknown group '" + name + "'; nearest is '" +
                             nearest_name(name, order_) + "'");
        if (std::find(path.begin(), path.end(), name) != path.end())
          return fail(e, "group '" + name + "' contains itself");
        if (!finished.count(name)) collect(sub->second, out, joints, path, finished);
      }
    }
    finished.insert(path.back());
    path.pop_back();
  }

  void add_chain(const XMLElement* e, SrdfGroup& out, std::set<JointId>& joints, bool own) {
    const LinkId base = link(e, "base_link"), tip = link(e, "tip_link");
    if (!base.valid() || !tip.valid()) return;
    std::set<JointId> chain;
    LinkId at = tip;
    while (at != base) {
      const JointId id = model_.links[at.index()].parent_joint;
      if (!id.valid())
        return fail(e, "chain: link '" + name_of(base) + "' is not above link '" + name_of(tip) + "' in the robot");
      add(id, chain);
      at = model_.joints[id.index()].parent;
    }
    joints.insert(chain.begin(), chain.end());
    if (own && out.tip.empty()) out.base = name_of(base), out.tip = name_of(tip);
  }

  void read_state(const XMLElement* state) {
    const std::string name = attribute(state, "name"), group = attribute(state, "group");
    if (name.empty()) return fail(state, "<group_state> without a name");
    if (!groups_.count(group))
      return fail(state, "state '" + name + "' is for the unknown group '" + group + "'; nearest is '" +
                             nearest_name(group, order_) + "'");
    auto& values = srdf_.states[name];
    for (const XMLElement* e = state->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      if (!joint(e).valid()) return;
      const auto value = parse_numbers(attribute(e, "value"), 1);
      if (!value)
        return fail(e, "state '" + name + "': value of joint '" + attribute(e, "name") + "' is '" +
                           attribute(e, "value").substr(0, 60) + "', expected a finite number");
      values[attribute(e, "name")] = (*value)[0];
    }
  }

  std::optional<std::pair<LinkId, LinkId>> link_pair(const XMLElement* e) {
    const LinkId a = link(e, "link1"), b = link(e, "link2");
    if (!a.valid() || !b.valid()) return std::nullopt;
    return std::pair(std::min(a, b), std::max(a, b));
  }
  void read_disabled(const XMLElement* e) {
    if (const auto pair = link_pair(e); pair && pair->first != pair->second) disabled_.insert(*pair);
  }
  void disable_default(const XMLElement* e) {
    const LinkId a = link(e, "link");
    if (!a.valid()) return;
    for (std::size_t i = 0; i < model_.links.size(); ++i)
      if (LinkId(i) != a) disabled_.emplace(std::min(a, LinkId(i)), std::max(a, LinkId(i)));
  }

  const XmlFile& file_;
  const RobotModel& model_;
  std::map<std::string, const XMLElement*> groups_;
  std::vector<std::string> order_;  // of the file
  std::set<std::pair<LinkId, LinkId>> disabled_;
  Srdf srdf_;
  std::optional<Error> error_;
};

}  // namespace

Result<Srdf> load_srdf(const std::string& path, const RobotModel& model) {
  Result<XmlFile> file = load_xml(path, "robot");
  if (!file) return file.error();
  return SrdfReader(*file, model).read();
}

}  // namespace mamo::io
