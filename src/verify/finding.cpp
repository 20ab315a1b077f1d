#include "verify/finding.hpp"

#include <cstdio>

namespace mamo::verify {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", value);
  return text;
}

std::string segment_name(const Scene& scene, const Plan& plan, int segment) {
  std::string text = "segment " + std::to_string(segment);
  if (segment < 0 || static_cast<std::size_t>(segment) >= plan.segments.size()) return text;
  const Segment& s = plan.segments[static_cast<std::size_t>(segment)];
  text += " (" + std::string(to_string(s.kind));
  if (s.object.valid() && s.object.index() < scene.size()) text += " of " + scene[s.object].id;
  return text + ")";
}

/// A touch has no other limit than "not at all"; its value is how deep.
bool is_touch(ViolationKind kind) {
  return kind == ViolationKind::robot_touch || kind == ViolationKind::object_touch ||
         kind == ViolationKind::self_collision;
}

}  // namespace

std::string name_of(const Scene& scene, ObjectId id) {
  if (id == kRobot) return "the robot";
  if (id == kFloor) return "the floor";
  if (!id.valid() || id.index() >= scene.size()) return "nothing";
  return scene[id].id;
}

Verdict::Finding make_finding(const Scene& scene, const Plan& plan, int segment, const Violation& v,
                              const std::string& detail) {
  Verdict::Finding finding;
  finding.segment = segment;
  finding.violation = v;
  std::string& text = finding.text;
  text = segment_name(scene, plan, segment) + ", " + seconds(v.time_s) + ": " + std::string(to_string(v.kind));
  if (v.object != kNoObject) text += " of " + name_of(scene, v.object);
  if (v.other != kNoObject) text += " with " + name_of(scene, v.other);
  if (v.kind != ViolationKind::malformed_plan) {
    const std::string unit = " " + std::string(unit_of(v.kind));
    text += is_touch(v.kind) ? ", " + number(v.value) + unit + " deep, limit none"
                             : ", " + number(v.value) + unit + ", limit " + number(v.limit) + unit;
  }
  if (!detail.empty()) text += " (" + detail + ")";
  return finding;
}

}  // namespace mamo::verify
