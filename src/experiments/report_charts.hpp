// Records of one suite, grouped by setting and planner, and the charts that they allow.
#pragma once

#include <string>
#include <vector>

#include "mamo/experiments/chart.hpp"
#include "mamo/experiments/record.hpp"
#include "mamo/experiments/report.hpp"

namespace mamo {

/// Runs of one planner (by label) on one setting, in the order of problems.
struct Group {
  std::string setting, label;
  std::vector<const Record*> runs;  // never empty
};

struct SuiteRecords {
  std::string name;
  std::vector<Group> groups;
};

/// In an order that does not depend on that of the records; repeated runs dropped.
std::vector<SuiteRecords> by_suite(const std::vector<Record>& records);
void order_labels(SuiteRecords& suite);

/// Success against the number of objects and of immovable objects (where the suite varies them), against the simulation
/// budget, and the cactus: what share was solved within a time.
std::vector<Chart> charts_of(const SuiteRecords& suite);

}  // namespace mamo
