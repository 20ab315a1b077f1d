// What a file is, by its content.
#pragma once

#include <string>

#include "mamo/common/result.hpp"

namespace mamo::tool {

enum class FileKind { robot, problem, plan };

/// XML is a robot, JSON with a plan's keys a plan, anything else a problem (whose loader says what is wrong with it).
Result<FileKind> kind_of_file(const std::string& path);

}  // namespace mamo::tool
