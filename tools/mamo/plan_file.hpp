// A plan file by itself, without the problem it was made for.
#pragma once

#include <string>

#include "mamo/common/result.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::tool {

/// What a result object says about itself; empty where it does not (a bare plan, another file).
struct PlanFacts {
  std::string planner, status, problem, problem_sha256, signature;
};
PlanFacts read_plan_facts(const std::string& path);

/// A stand-in for the problem of a plan, enough to read and export it: a robot with the joints that the plan names (no
/// limits, no shapes) and a scene with the objects that it names. Lenient: what is malformed is left to io::load_plan.
Problem stand_in_problem(const std::string& plan_path);

}  // namespace mamo::tool
