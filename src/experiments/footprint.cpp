#include "experiments/footprint.hpp"

#include <numbers>

namespace mamo {
namespace {

constexpr int kCircleSides = 16;

/// Separating axis among the edge normals of `a`: everything of `b` at least `gap` beyond an edge.
bool edge_separates(const Footprint& a, const Footprint& b, double gap) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Eigen::Vector2d outward = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
    const auto beyond = [&](const Eigen::Vector2d& p) { return outward.dot(p - a[i]) >= gap; };
    if (std::all_of(b.begin(), b.end(), beyond)) return true;
  }
  return false;
}

}  // namespace

Footprint footprint(const Shape& shape, double x, double y, double yaw) {
  Footprint outline;
  if (const Box* box = std::get_if<Box>(&shape)) {
    const double hx = box->size.x() / 2, hy = box->size.y() / 2;
    outline = {{hx, hy}, {-hx, hy}, {-hx, -hy}, {hx, -hy}};
  } else {
    const Eigen::Vector3d half = bounds(shape, Eigen::Isometry3d::Identity()).max();
    const double r = std::max(half.x(), half.y()) / std::cos(std::numbers::pi / kCircleSides);
    for (int i = 0; i < kCircleSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kCircleSides;
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  }
  const Eigen::Rotation2Dd turn(yaw);
  for (Eigen::Vector2d& p : outline) p = turn * p + Eigen::Vector2d(x, y);
  return outline;
}

bool closer_than(const Footprint& a, const Footprint& b, double gap) {
  return !edge_separates(a, b, gap) && !edge_separates(b, a, gap);
}

}  // namespace mamo
