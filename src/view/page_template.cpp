#include "view/page_template.hpp"

#include <stdexcept>

#include "view/embedded.hpp"
#include "view/palette.hpp"

namespace mamo::view {
namespace {

std::string variables(std::string_view Colour::*shade) {
  std::string out;
  for (const Colour& colour : kPalette) out += "--" + std::string(colour.name) + ":" + std::string(colour.*shade) + ";";
  return out;
}

}  // namespace

std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& values) {
  std::string out;
  for (;;) {
    const std::size_t open = page.find("{{");
    out += page.substr(0, open);
    if (open == std::string_view::npos) return out;
    const std::size_t close = page.find("}}", open);
    if (close == std::string_view::npos) throw std::logic_error("page template: '{{' without '}}'");
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("page template: no value for " + std::string(name));
    out += value->second;
    page.remove_prefix(close + 2);
  }
}

std::string page_style() {
  return filled(embedded("house.css"), {{"light", variables(&Colour::light)}, {"dark", variables(&Colour::dark)}});
}

}  // namespace mamo::view
