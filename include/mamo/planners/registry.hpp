// Planners by name, with their options.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

/// In the order in which they are listed for a person.
std::vector<std::string> planner_names();
/// Null if there is none of that name.
std::unique_ptr<Planner> make_planner(const std::string& name);
/// Options that PlanOptions::set understands for a planner; empty if there is none of that name.
std::vector<OptionDoc> planner_options(const std::string& planner);

}  // namespace mamo
