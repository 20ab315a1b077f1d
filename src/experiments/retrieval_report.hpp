// What reports say about retrieval problems: Tables 1 and 2 and Figures 7 and 8 of the E-M4M paper, ours and published.
#pragma once

#include <vector>

#include "experiments/report_charts.hpp"

#include "mamo/experiments/report.hpp"

namespace mamo {

/// Nothing for suites without retrievals. Solved by difficulty (by our own negative goal region, and as listed where
/// the list says it), in the paper's form and in full, and the order of the planners against the paper's.
std::vector<Table> retrieval_tables(const SuiteRecords& suite);

/// Planning and simulation time by difficulty and planner (box plots), and where the time went (medians).
std::vector<Figure> retrieval_figures(const SuiteRecords& suite);

}  // namespace mamo
