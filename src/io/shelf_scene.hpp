// The published shelf scenes, `plan_NNNNNN_SCENE.txt` (EM4M_FACTS section 1, FORMATS section 1).
#pragma once

#include <string>

#include "io/strict_reader.hpp"
#include "mamo/io/load.hpp"

namespace mamo::io {

/// Is this such a file? (Its first line is the letter O.)
bool looks_like_shelf_scene(const std::string& text);

/// Fills `problem` but for name, path and sha256: the shipped PR2 at home, profile full, task retrieve.
void read_shelf_scene(const std::string& text, const LoadOptions& options, Problem& problem, Complaints& complaints);

}  // namespace mamo::io
