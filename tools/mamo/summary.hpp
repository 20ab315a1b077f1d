// A result in words, for a person.
#pragma once

#include <string>

#include "console.hpp"

#include "mamo/model/planner.hpp"

namespace mamo::tool {

/// "reach pose", "reach joints" or "retrieve soup".
std::string task_name(const Problem& problem);

/// Which limit stopped the run and the option that raises it; the planner's own reason if it says so already.
std::string why_no_plan(const PlanResult& result, const PlanOptions& options, double time_limit_s,
                        std::int64_t memory_limit_mb);

/// The lines that `mamo plan` prints without --json.
std::string summary(const PlanResult& result, const Problem& problem, const Console& console);

/// What "proven" rests on; one assumption a line.
std::string proven_assumptions();

/// "verified", "2 segments, 31 points, 12.4 s: approach, push mug".
std::string plan_line(const Plan& plan, const Scene& scene);

std::string progress_line(const Progress& progress);

}  // namespace mamo::tool
