// What a file is, told from its content, so that a wrong file gets a message that names it.
#pragma once

#include <string>

#include "mamo/common/result.hpp"

namespace mamo::io {

/// Text at all: not empty, no NUL and few control characters. The error says which, with the path.
Status check_is_text(const std::string& text, const std::string& path);

/// A file that is certainly no problem and no YAML either (XML, JSON result, MoveIt scene text, a mesh):
/// "... looks like a URDF ...". Ok when it may be YAML.
Status refuse_foreign(const std::string& text, const std::string& path);

}  // namespace mamo::io
