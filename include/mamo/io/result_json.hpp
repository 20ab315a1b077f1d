// Results, plans and verdicts as JSON (INTERFACE: "mamo-result/1", "mamo-verdict/1"). One object, one line
// unless an indent is asked for; keys in the order of INTERFACE; numbers round-trip exactly; what is not
// finite is written as null.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "mamo/model/planner.hpp"

namespace mamo::io {

/// How many of n disturbed replays survived (verify --robust N).
struct RobustReport {
  std::int64_t n = 0, survived = 0;
  double rate = 0;
  std::array<double, 2> ci95{0, 0};
  std::map<std::string, std::int64_t> causes;  // violation kind -> count
};

/// "soup"; "robot" and "floor" for the two that are no objects; empty for kNoObject.
std::string object_name(const Scene& scene, ObjectId id);

/// The result object. indent < 0: one line.
std::string result_json(const PlanResult& result, const Problem& problem, int indent = -1);
/// The bare plan: {"segments": [...]}.
std::string plan_json(const Plan& plan, const Scene& scene, int indent = -1);
/// The verdict object; `robust` may be null.
std::string verdict_json(const Verdict& verdict, const Scene& scene, const RobustReport* robust = nullptr,
                         int indent = -1);

}  // namespace mamo::io
