#include "view/embedded.hpp"
#include "view/page_template.hpp"

#include "mamo/view/page.hpp"
#include "mamo/view/svg.hpp"

namespace mamo::view {

std::string document_page(const std::string& title, const std::string& body) {
  return filled(embedded("document.html"),
                {{"title", escaped(title)},
                 {"style", page_style() + std::string(embedded("document.css"))},
                 {"body", body},
                 {"script", std::string(embedded("theme.js")) + std::string(embedded("tables.js"))}});
}

}  // namespace mamo::view
