// Options that every planning subcommand shares: planner, limits, threads, seed, planner-specific settings.
#pragma once

#include <CLI/CLI.hpp>

#include "config_file.hpp"
#include "console.hpp"

#include "mamo/model/planner.hpp"

namespace mamo::tool {

struct PlanningOptions {
  std::string planner;  // empty: the task decides (settle_planner)
  PlanOptions plan;
  double time_limit_s = 60;
  std::int64_t memory_limit_mb = 0;  // 0: none
  bool no_smooth = false;
  std::string config;
  std::vector<std::string> settings;  // key=value as given
  std::vector<ConfigEntry> unshared;  // entries of the config file that only a planner can know
};

void add_planning_options(CLI::App& command, PlanningOptions& options);

/// After parsing: reads --config (the command line wins over it). If a planner was named its own options are settled.
Status complete(CLI::App& command, PlanningOptions& options, Console& console);

/// Once the planner is known: checks every planner-specific name and fills plan.set. Options of other planners in the
/// config file are passed over, so that one file can serve several planners.
Status settle_planner(CLI::App& command, PlanningOptions& options, const std::string& planner, Console& console);

/// Planner-specific options of all planners as a help text, or "" when there are none.
std::string describe_planner_options();

}  // namespace mamo::tool
