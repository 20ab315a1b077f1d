// Generated problems, planned with a judge: what tests of whole planners share.
#pragma once

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "mamo/experiments/tabletop.hpp"
#include "mamo/planners/registry.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo::fixtures {

/// Memory that sanitizers keep and time that they take say nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// tools/check --long sets it; a tenth of the speed is long enough without.
inline bool long_run() { return !kSanitized && std::getenv("MAMO_LONG") != nullptr; }

/// Resident memory of this process (kB).
inline long resident_kb() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4;
}

inline Problem tabletop(int movable, int immovable, std::uint64_t seed, int index) {
  TabletopSpec spec;
  spec.movable = movable;
  spec.immovable = immovable;
  spec.seed = seed;
  spec.index = index;
  auto problem = generate_tabletop(spec);
  if (!problem) throw std::runtime_error(problem.error().message);
  return *std::move(problem);
}

inline PlanResult planned(const Problem& problem, const std::string& planner, const PlanOptions& options,
                          StopSource& stop) {
  const Verifier judge;
  PlanContext context;
  context.stop = &stop;
  context.judge = &judge;
  return make_planner(planner)->plan(problem, options, context);
}
inline PlanResult planned(const Problem& problem, const std::string& planner, const PlanOptions& options) {
  StopSource stop;
  return planned(problem, planner, options, stop);
}

}  // namespace mamo::fixtures
