// The colours of bodies and segments in three dimensions: one table for playback pages and pictures.
#pragma once

#include <array>
#include <string_view>

namespace mamo::view {

struct Colour {
  std::string_view name;         // of the CSS variable
  std::string_view light, dark;  // "#rrggbb" on light and on dark pages
};

inline constexpr std::array<Colour, 16> kPalette = {{
    {"target", "#2f9e44", "#40c057"},
    {"immovable", "#d6453d", "#f26d65"},
    {"movable", "#5b9be6", "#5b9be6"},
    {"moved", "#f59f1b", "#ffb03b"},
    {"relevant", "#a07cf0", "#b197fc"},
    {"fixture", "#d8d0c4", "#6d675f"},
    {"body", "#c3c9d1", "#69727d"},
    {"arm", "#8b95a5", "#a3adbc"},
    {"contact", "#ff2d55", "#ff5c7c"},
    {"approach", "#1c7ed6", "#4dabf7"},
    {"push", "#e8590c", "#ff922b"},
    {"retreat", "#868e96", "#adb5bd"},
    {"reach", "#7048e8", "#9775fa"},
    {"grasp", "#d6336c", "#f06595"},
    {"extract", "#2b8a3e", "#51cf66"},
    {"goal", "#237a3b", "#69db7c"},
}};

constexpr const Colour& colour_of(std::string_view name) {
  for (const Colour& colour : kPalette)
    if (colour.name == name) return colour;
  return kPalette.front();
}

}  // namespace mamo::view
