// What a simulated motion did: who touched whom, and the first thing that went wrong.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mamo/common/ids.hpp"

namespace mamo {

/// Constraint kinds, named in results by to_string().
enum class ViolationKind {
  robot_touch,       // the robot touched a body it may not touch; object = that body
  object_touch,      // object was touched by other, or touched a fixture it may not
  tilt,              // rad
  speed,             // m/s
  left_support,      // value: metres below or beside the support
  displacement,      // m
  immovable_moved,   // m
  penetration,       // m
  not_at_rest,       // m/s at the settle limit
  self_collision,    // verify and the planner's start check
  joint_limit,       // rad or m
  joint_velocity,    // rad/s or m/s
  discontinuity,     // rad or m between successive points or segments
  wrong_start,       // rad or m
  objects_mismatch,  // objects_after of the plan differs from the replay (m)
  task_not_done,     // m or rad from the goal
  malformed_plan,
};
std::string_view to_string(ViolationKind kind);
/// "m", "rad", "m/s", ... of value and limit.
std::string_view unit_of(ViolationKind kind);

struct Violation {
  ViolationKind kind{};
  ObjectId object = kNoObject;  // the object O_v with respect to which the constraint was violated
  ObjectId other = kNoObject;   // kRobot, another object, a fixture, kFloor or kNoObject
  double value = 0, limit = 0;  // units by kind
  double time_s = 0;            // from the start of the motion
};

/// Two bodies that touched while one of them moved because of the robot. a < b by id, or a == kRobot.
/// `b` is never a fixture: fixtures and the floor are no nodes of the interaction tree.
struct Interaction {
  ObjectId a, b;
  double first_time_s = 0;
  friend bool operator==(const Interaction&, const Interaction&) = default;
};

}  // namespace mamo
