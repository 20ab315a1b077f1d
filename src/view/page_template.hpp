// HTML templates: a file with {{names}} in it.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace mamo::view {

/// Every {{name}} of the template replaced by its value; values are not looked at again. Throws std::logic_error for a
/// name without value.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& values);

/// The house's look, with the palette as CSS variables. For a style element.
std::string page_style();

}  // namespace mamo::view
