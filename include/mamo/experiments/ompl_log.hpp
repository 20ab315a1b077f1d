// Results as OMPL benchmark logs, which `ompl_benchmark_statistics` and Planner Arena read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mamo/experiments/record.hpp"

namespace mamo {

/// (file name, content), one log for every suite and setting. Its runs are the problems and seeds of the setting, each
/// with the properties time, solved, status (all as Planner Arena expects them), found, counters and the problem's number
/// among the sorted problems of the setting. A run that stands in two files counts once. Memory is not limited: 0 MB.
std::vector<std::pair<std::string, std::string>> ompl_logs(const std::vector<Record>& records);

}  // namespace mamo
