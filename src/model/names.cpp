// Names of enumerations as they stand in files and messages.
#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

std::string_view to_string(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::robot_touch:
      return "robot_touch";
    case ViolationKind::object_touch:
      return "object_touch";
    case ViolationKind::tilt:
      return "tilt";
    case ViolationKind::speed:
      return "speed";
    case ViolationKind::left_support:
      return "left_support";
    case ViolationKind::displacement:
      return "displacement";
    case ViolationKind::immovable_moved:
      return "immovable_moved";
    case ViolationKind::penetration:
      return "penetration";
    case ViolationKind::not_at_rest:
      return "not_at_rest";
    case ViolationKind::self_collision:
      return "self_collision";
    case ViolationKind::joint_limit:
      return "joint_limit";
    case ViolationKind::joint_velocity:
      return "joint_velocity";
    case ViolationKind::discontinuity:
      return "discontinuity";
    case ViolationKind::wrong_start:
      return "wrong_start";
    case ViolationKind::objects_mismatch:
      return "objects_mismatch";
    case ViolationKind::task_not_done:
      return "task_not_done";
    case ViolationKind::malformed_plan:
      return "malformed_plan";
  }
  return "unknown";
}

std::string_view unit_of(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::tilt:
      return "rad";
    case ViolationKind::speed:
    case ViolationKind::not_at_rest:
      return "m/s";
    case ViolationKind::joint_velocity:
      return "rad/s";
    case ViolationKind::joint_limit:
    case ViolationKind::discontinuity:
    case ViolationKind::wrong_start:
      return "rad";
    case ViolationKind::malformed_plan:
      return "";
    default:
      return "m";
  }
}

std::string_view to_string(Profile profile) {
  switch (profile) {
    case Profile::contact_only:
      return "contact-only";
    case Profile::full:
      return "full";
    case Profile::legacy:
      return "legacy";
  }
  return "unknown";
}

std::string_view to_string(SegmentKind kind) {
  switch (kind) {
    case SegmentKind::approach:
      return "approach";
    case SegmentKind::push:
      return "push";
    case SegmentKind::retreat:
      return "retreat";
    case SegmentKind::reach:
      return "reach";
    case SegmentKind::grasp:
      return "grasp";
    case SegmentKind::extract:
      return "extract";
  }
  return "unknown";
}

std::string_view to_string(PlanStatus status) {
  switch (status) {
    case PlanStatus::solved:
      return "solved";
    case PlanStatus::limit:
      return "limit";
    case PlanStatus::timeout:
      return "timeout";
    case PlanStatus::proven:
      return "proven";
    case PlanStatus::interrupted:
      return "interrupted";
    case PlanStatus::memory:
      return "memory";
    case PlanStatus::invalid:
      return "invalid";
    case PlanStatus::error:
      return "error";
  }
  return "unknown";
}

int exit_code(PlanStatus status) {
  switch (status) {
    case PlanStatus::solved:
      return 0;
    case PlanStatus::limit:
    case PlanStatus::timeout:
    case PlanStatus::interrupted:
    case PlanStatus::memory:
      return 1;
    case PlanStatus::proven:
      return 2;
    case PlanStatus::invalid:
      return 3;
    case PlanStatus::error:
      return 70;
  }
  return 70;
}

}  // namespace mamo
