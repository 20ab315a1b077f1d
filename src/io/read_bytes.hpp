// A whole file in memory.
#pragma once

#include <string>

#include "mamo/common/result.hpp"

namespace mamo::io {

/// At most max_bytes. Errors name the path: missing, a folder, too large, unreadable.
Result<std::string> read_bytes(const std::string& path, std::size_t max_bytes);

}  // namespace mamo::io
