// What a problem asks for, out of the native problem file, and what --task makes of it.
#pragma once

#include "io/strict_reader.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::io {

/// The map `task`. The problem's robot, start and scene are known already.
Task read_task(const YamlValue& value, const Problem& problem, Complaints& complaints);

/// --task reach|retrieve: turns the task into the other kind where that makes sense. Error kind: usage.
Status change_task(const std::string& wanted, Problem& problem);

/// The target of a reach must not be touched, whatever its own settings say.
void protect_target(Problem& problem);

}  // namespace mamo::io
