#include "mamo/io/profile.hpp"

#include <numbers>

namespace mamo::io {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

std::optional<Profile> parse_profile(std::string_view name) {
  for (Profile p : {Profile::contact_only, Profile::full, Profile::legacy})
    if (mamo::to_string(p) == name) return p;
  return std::nullopt;
}

std::string_view to_string(Touch touch) {
  switch (touch) {
    case Touch::allowed: return "allowed";
    case Touch::robot: return "robot";
    case Touch::objects: return "objects";
    case Touch::forbidden: return "forbidden";
    case Touch::support: return "support";
  }
  return "unknown";
}

std::optional<Touch> parse_touch(std::string_view name) {
  for (Touch t : {Touch::allowed, Touch::robot, Touch::objects, Touch::forbidden, Touch::support})
    if (to_string(t) == name) return t;
  return std::nullopt;
}

InteractionConstraints default_constraints(Profile profile, ObjectKind kind) {
  InteractionConstraints c;
  if (kind == ObjectKind::fixture) {
    c.touch = Touch::support;
  } else if (kind == ObjectKind::immovable) {
    c.touch = Touch::forbidden;
  } else if (profile == Profile::full) {
    c.max_tilt = 25 * kDegree;
    c.max_speed = 1.0;
    c.may_leave_support = false;
  } else if (profile == Profile::legacy) {
    c.max_tilt = 38.8 * kDegree;
    c.max_speed = 0.95;
    c.may_leave_support = false;
  }
  return c;
}

}  // namespace mamo::io
