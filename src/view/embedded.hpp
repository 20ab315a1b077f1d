// Files that the build put into the library: src/view/page and three.js.
#pragma once

#include <string>
#include <string_view>

namespace mamo::view {

/// By name without folder. Throws std::logic_error for a name that is not there.
std::string_view embedded(std::string_view name);

}  // namespace mamo::view
