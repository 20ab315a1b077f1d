// Documents in the look of the playback pages.
#pragma once

#include <string>

namespace mamo::view {

/// One self-contained HTML page around a body of HTML: light and dark, tables of class "data" sort by their headings
/// and can be searched, wide ones scroll in a div of class "wide".
std::string document_page(const std::string& title, const std::string& body);

}  // namespace mamo::view
