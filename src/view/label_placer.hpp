// Puts labels where they do not cover one another.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace mamo::view {

struct LabelPlace {
  Eigen::Vector2d centre;  // px
  bool far = false;        // away from its anchor: wants a leader line
};

/// Greedy, in the order of the calls: the anchor itself, then rings around it, first place that is free. Deterministic.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Eigen::AlignedBox2d& canvas) : canvas_(canvas) {}

  /// A box that labels keep off.
  void block(const Eigen::AlignedBox2d& box) { taken_.push_back(box); }
  /// `size`: of the text (px). `radius`: of what is labelled (px); a text no wider than that may sit on it.
  /// Nothing if every place is taken.
  std::optional<LabelPlace> place(const Eigen::Vector2d& anchor, double radius, const Eigen::Vector2d& size);

 private:
  bool free(const Eigen::AlignedBox2d& box) const;
  Eigen::AlignedBox2d canvas_;
  std::vector<Eigen::AlignedBox2d> taken_;
};

/// Width and height of a text in a sans-serif font, estimated.
Eigen::Vector2d text_size(const std::string& text, double font_px);

}  // namespace mamo::view
