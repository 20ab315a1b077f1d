// The runs of a suite, side by side.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mamo/common/stop.hpp"
#include "mamo/experiments/record.hpp"

namespace mamo::tool {

struct FinishedRun {
  const BenchRun* run = nullptr;
  PlanResult result;
  std::string line;  // for the results file
};

struct BenchOptions {
  int jobs = 1;     // runs at a time
  int threads = 1;  // inside one run, where the suite says nothing
  bool keep_plans = true;
  std::string pages;  // folder for a playback page of every run that has a plan or a reason; empty: none
};

/// Calls `finished` for every run, one call at a time, in the order in which they end; nothing of a run depends on the
/// others but its times. Ends early when `stop` fires (runs under way are dropped) or `finished` returns an error,
/// which is returned. A value that a planner's option cannot take is an error of kind usage.
Status run_all(const Suite& suite, const std::vector<BenchRun>& runs, const BenchOptions& options,
               const RunMachine& machine, StopSource& stop, const std::function<Status(const FinishedRun&)>& finished);

}  // namespace mamo::tool
