#include "view/label_placer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mamo::view {

Eigen::Vector2d text_size(const std::string& text, double font_px) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return {0.58 * font_px * static_cast<double>(letters), 1.1 * font_px};
}

bool LabelPlacer::free(const Eigen::AlignedBox2d& box) const {
  if (!canvas_.contains(box)) return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const auto& other) {
    return !(box.max().x() <= other.min().x() || other.max().x() <= box.min().x() ||
             box.max().y() <= other.min().y() || other.max().y() <= box.min().y());
  });
}

std::optional<LabelPlace> LabelPlacer::place(const Eigen::Vector2d& anchor, double radius,
                                             const Eigen::Vector2d& size) {
  const auto attempt = [&](const Eigen::Vector2d& centre) {
    const Eigen::AlignedBox2d box(centre - size / 2, centre + size / 2);
    if (!free(box)) return false;
    taken_.push_back(box);
    return true;
  };
  if (size.x() <= 2.2 * radius && attempt(anchor)) return LabelPlace{anchor, false};
  for (int ring = 0; ring < 6; ++ring) {
    for (int k = 0; k < 12; ++k) {
      // Below first (y grows downwards), then alternating to both sides.
      const double a = std::numbers::pi / 2 + (k % 2 ? 1 : -1) * std::numbers::pi / 6 * ((k + 1) / 2);
      const Eigen::Vector2d d(std::cos(a), std::sin(a));
      const double gap = radius + 3 + 13.0 * ring;
      const Eigen::Vector2d centre = anchor + d * gap + Eigen::Vector2d(d.x() * size.x(), d.y() * size.y()) / 2;
      if (attempt(centre)) return LabelPlace{centre, ring > 0};
    }
  }
  if (attempt(anchor)) return LabelPlace{anchor, false};
  return std::nullopt;
}

}  // namespace mamo::view
