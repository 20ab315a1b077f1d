#include "io/urdf_check.hpp"

#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMostElements = 20000;  // links or joints

/// Attributes that must be numbers, by element. Positive: sizes.
struct NumberRule {
  const char* element;
  const char* attribute;
  std::size_t count;
  bool required;
  bool positive;
};
constexpr NumberRule kNumberRules[] = {
    {"origin", "xyz", 3, false, false},       {"origin", "rpy", 3, false, false},
    {"axis", "xyz", 3, true, false},          {"box", "size", 3, true, true},
    {"cylinder", "radius", 1, true, true},    {"cylinder", "length", 1, true, true},
    {"sphere", "radius", 1, true, true},      {"mesh", "scale", 3, false, false},
    {"limit", "lower", 1, false, false},      {"limit", "upper", 1, false, false},
    {"limit", "velocity", 1, false, false},   {"limit", "effort", 1, false, false},
    {"mimic", "multiplier", 1, false, false}, {"mimic", "offset", 1, false, false},
    {"mass", "value", 1, true, false},
};

std::string plural(std::size_t count) {
  return count == 1 ? "a finite number" : std::to_string(count) + " finite numbers";
}

class Checker {
 public:
  explicit Checker(const XmlFile& file) : file_(file) {}

  Result<UrdfLines> run() {
    for (const XMLElement* e = file_.root->FirstChildElement(); e && !error_; e = e->NextSiblingElement()) {
      const std::string kind = e->Name();
      if (kind.rfind("xacro:", 0) == 0)
        fail(e, "<" + kind + ">: this is a xacro file; run xacro on it first");
      else if (kind == "link")
        remember(e, lines_.links), check_link(e);
      else if (kind == "joint")
        remember(e, lines_.joints), check_numbers(e);
    }
    for (const XMLElement* e = file_.root->FirstChildElement("joint"); e && !error_; e = e->NextSiblingElement("joint"))
      check_joint(e);
    if (!error_ && lines_.links.empty()) fail(file_.root, "no <link> in the robot");
    if (error_) return *error_;
    return std::move(lines_);
  }

 private:
  void fail(const XMLElement* where, const std::string& message) {
    if (!error_) error_ = file_.error_at(where, message);
  }

  void remember(const XMLElement* e, std::map<std::string, int>& names) {
    const std::string name = attribute(e, "name"), kind = e->Name();
    if (name.empty()) return fail(e, "<" + kind + "> without a name");
    if (!names.emplace(name, e->GetLineNum()).second)
      return fail(e, kind + " '" + name + "' is defined twice (first in line " + std::to_string(names[name]) + ")");
    if (names.size() > kMostElements)
      fail(e, "more than " + std::to_string(kMostElements) + " elements <" + kind + ">");
  }

  void check_link(const XMLElement* link) {
    const std::string name = attribute(link, "name");
    for (const XMLElement* c = link->FirstChildElement(); c; c = c->NextSiblingElement()) {
      const bool collision = std::string(c->Name()) == "collision";
      if (!collision && std::string(c->Name()) != "visual") continue;
      const XMLElement* geometry = c->FirstChildElement("geometry");
      const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
      if (!shape) return fail(c, "link '" + name + "': <" + c->Name() + "> without a geometry");
      const std::string kind = shape->Name();
      if (kind != "box" && kind != "cylinder" && kind != "sphere" && kind != "mesh")
        return fail(shape,
                    "link '" + name + "': unsupported geometry <" + kind + ">, expected box, cylinder, sphere or mesh");
      if (kind == "mesh" && attribute(shape, "filename").empty())
        return fail(shape, "link '" + name + "': <mesh> without a filename");
    }
    check_numbers(link);
  }

  void check_numbers(const XMLElement* e) {
    for (const NumberRule& rule : kNumberRules) {
      if (std::string_view(e->Name()) != rule.element) continue;
      const char* text = e->Attribute(rule.attribute);
      const std::string what = "<" + std::string(rule.element) + " " + rule.attribute + ">";
      if (!text) {
        if (rule.required) fail(e, what + " is missing, expected " + plural(rule.count));
        continue;
      }
      const auto numbers = parse_numbers(text, rule.count);
      if (!numbers)
        return fail(e, what + " is '" + std::string(text).substr(0, 60) + "', expected " + plural(rule.count));
      for (double x : *numbers)
        if (rule.positive && !(x > 0)) return fail(e, what + " is '" + text + "', expected sizes above 0");
    }
    for (const XMLElement* c = e->FirstChildElement(); c && !error_; c = c->NextSiblingElement()) check_numbers(c);
  }

  void check_reference(const XMLElement* joint, const char* element, const char* key,
                       const std::map<std::string, int>& known, bool required) {
    const std::string name = attribute(joint, "name");
    const XMLElement* e = joint->FirstChildElement(element);
    if (!e) {
      if (required) fail(joint, "joint '" + name + "' has no <" + element + ">");
      return;
    }
    const std::string target = attribute(e, key);
    if (known.count(target)) return;
    std::vector<std::string> names;
    for (const auto& [k, line] : known) names.push_back(k);
    fail(e, "joint '" + name + "': unknown " + key + " '" + target + "'; nearest is '" + nearest_name(target, names) +
                "'");
  }

  void check_joint(const XMLElement* joint) {
    const std::string name = attribute(joint, "name"), type = attribute(joint, "type");
    if (type == "floating" || type == "planar")
      return fail(joint,
                  "joint '" + name + "': type '" + type + "' is not supported (place the robot with its base pose)");
    if (type != "fixed" && type != "revolute" && type != "continuous" && type != "prismatic")
      return fail(joint,
                  "joint '" + name + "': type '" + type + "', expected fixed, revolute, continuous or prismatic");
    check_reference(joint, "parent", "link", lines_.links, true);
    check_reference(joint, "child", "link", lines_.links, true);
    if (type == "fixed") return;
    check_reference(joint, "mimic", "joint", lines_.joints, false);
    if (const XMLElement* axis = joint->FirstChildElement("axis")) {
      const auto xyz = parse_numbers(attribute(axis, "xyz"), 3);
      if (xyz && std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]) < 1e-9)
        fail(axis, "joint '" + name + "': axis of length 0");
    }
    if (type == "continuous") return;
    const XMLElement* limit = joint->FirstChildElement("limit");
    if (!limit) return fail(joint, "joint '" + name + "': a " + type + " joint needs <limit>");
    const auto number = [&](const char* key) {
      return parse_numbers(attribute(limit, key), 1).value_or(std::vector{0.0})[0];
    };
    if (number("lower") > number("upper"))
      fail(limit, "joint '" + name + "': lower limit " + attribute(limit, "lower") + " is above upper limit " +
                      attribute(limit, "upper"));
  }

  const XmlFile& file_;
  UrdfLines lines_;
  std::optional<Error> error_;
};

}  // namespace

Result<UrdfLines> check_urdf(const XmlFile& file) { return Checker(file).run(); }

}  // namespace mamo::io
