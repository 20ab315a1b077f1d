// The named sets of constraints (ALGORITHMS, "Constraints and success").
#pragma once

#include <optional>
#include <string_view>

#include "mamo/model/problem.hpp"

namespace mamo::io {

/// "contact-only", "full", "legacy".
std::optional<Profile> parse_profile(std::string_view name);
/// "allowed", "robot", "objects", "forbidden", "support".
std::optional<Touch> parse_touch(std::string_view name);
std::string_view to_string(Touch touch);

/// What holds for an object of a kind when nothing else is said:
///  movable, contact-only: no limits; full: 25 degrees, 1 m/s, stays on its support;
///  legacy: 38.8 degrees and 0.95 m/s, the smallest values at which the published code reacts (EM4M_FACTS section 0);
///  immovable: nobody may touch it; fixture: objects may touch and stand on it.
InteractionConstraints default_constraints(Profile profile, ObjectKind kind);

}  // namespace mamo::io
