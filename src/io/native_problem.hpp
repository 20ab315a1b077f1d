// The native problem file (INTERFACE, "Native problem file (YAML)").
#pragma once

#include "io/strict_reader.hpp"
#include "mamo/io/load.hpp"

namespace mamo::io {

/// Fills everything of `problem` but name, path and sha256, which are set already. First complaint counts.
void read_native_problem(const YamlValue& root, const LoadOptions& options, Problem& problem, Complaints& complaints);

}  // namespace mamo::io
