// Options of every subcommand that reads a problem: where its robot, meshes and unstated masses come from.
#pragma once

#include <CLI/CLI.hpp>

#include "console.hpp"

#include "mamo/io/load.hpp"

namespace mamo::tool {

struct FileOptions {
  std::string problem;
  io::LoadOptions load;
  std::vector<std::string> package_paths;  // NAME=DIR as given
  double default_mass = 0, default_friction = 0;
  CLI::Option* mass_option = nullptr;
  CLI::Option* friction_option = nullptr;
};

/// PROBLEM as first positional argument, and the file options in a group of their own.
void add_problem(CLI::App& command, FileOptions& options);
void add_file_options(CLI::App& command, FileOptions& options);

/// Options as the loaders take them.
io::LoadOptions load_options(const FileOptions& options);

/// Loads, reports warnings, chooses the self-collision pairs: ready for validate(), planners and the verifier.
Result<Problem> load(const FileOptions& options, Console& console);

}  // namespace mamo::tool
