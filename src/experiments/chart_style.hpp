// What every chart looks like.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace mamo {

// Told apart by people who see few colours (Okabe and Ito 2008), in the order of use.
inline constexpr std::array<const char*, 8> kChartColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                             "#e69f00", "#56b4e9", "#7f7f7f", "#b8a800"};

// Alone it follows the system; inside a page, the page's own colours.
inline constexpr const char* kChartStyle =
    ".chart{font:13px system-ui,sans-serif}.chart .title{font-weight:600}.chart .hollow{stroke-width:2}"
    ".chart .paper,.chart .hollow{fill:var(--paper,#fff)}.chart text{fill:var(--ink,#222)}"
    ".chart .grid{stroke:var(--line,#ccc)}.chart .axis{stroke:var(--ink,#222)}.chart .line{fill:none;stroke-width:2}"
    "@media(prefers-color-scheme:dark){.chart .paper,.chart .hollow{fill:var(--paper,#14181d)}"
    ".chart text{fill:var(--ink,#ddd)}.chart .grid{stroke:var(--line,#444)}.chart .axis{stroke:var(--ink,#ddd)}}";

/// Of a tick or a value.
inline std::string chart_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// The beginning of a chart's SVG: the sheet, in px.
std::string chart_sheet(double width, double height, const std::string& title);

}  // namespace mamo
