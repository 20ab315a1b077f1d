#include "mapf/region_shadow.hpp"

#include <algorithm>

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;

constexpr double kTouch = 1e-9;  // m: sharing a boundary is no overlap

/// Cells of one row, [first, last], relative to a column's.
struct Run {
  int row, first, last;
};

/// The cells inside the shape, whose centres are at offset + cell * (integers).
std::vector<Run> runs_inside(const PlanarShape& shape, const Vector2d& offset, double cell) {
  std::vector<Run> out;
  const Vector2d lower = (shape.lower() - offset) / cell, upper = (shape.upper() - offset) / cell;
  for (int row = static_cast<int>(std::floor(lower.y())); row <= static_cast<int>(std::ceil(upper.y())); ++row) {
    Run run{row, 1, 0};
    for (int x = static_cast<int>(std::floor(lower.x())); x <= static_cast<int>(std::ceil(upper.x())); ++x)
      if (shape.signed_distance(offset + cell * Vector2d(x, row)) < -kTouch) {
        if (run.first > run.last) run.first = x;
        run.last = x;  // convex: one run
      }
    if (run.first <= run.last) out.push_back(run);
  }
  return out;
}

}  // namespace

std::pair<int, int> RegionShadow::layers(const Prism& prism) const {
  const double z = region_.origin().z(), cell = region_.cell();
  const auto index = [&](double v) { return static_cast<int>(std::clamp(v, 0.0, double(region_.size().z()))); };
  return {index(std::floor((prism.low - z) / cell + kTouch)), index(std::ceil((prism.high - z) / cell - kTouch))};
}

bool RegionShadow::marked(int i, int j, std::pair<int, int> layers) const {
  for (int k = layers.first; k < layers.second; ++k)
    if (region_.contains(Eigen::Vector3i(i, j, k))) return true;
  return false;
}

PlanarShape RegionShadow::around_column(const Prism& prism) const {
  const double c = region_.cell();
  return minkowski_difference(PlanarShape({{0, 0}, {c, 0}, {0, c}, {c, c}}, 0), prism.shadow);
}

bool RegionShadow::overlaps(const Footprint& footprint, const Vector2d& p) const {
  if (region_.count() == 0) return false;
  const Vector2d origin = region_.origin().head<2>();
  for (const Prism& prism : footprint.prisms) {
    const PlanarShape shape = around_column(prism);
    const auto reach = layers(prism);
    const Vector2d lower = (p - origin - shape.upper()) / region_.cell(),
                   upper = (p - origin - shape.lower()) / region_.cell();
    const auto first = [](double v) { return std::max(0, static_cast<int>(std::floor(v))); };
    const auto last = [](double v, int size) { return std::min(size - 1, static_cast<int>(std::ceil(v))); };
    for (int j = first(lower.y()); j <= last(upper.y(), region_.size().y()); ++j)
      for (int i = first(lower.x()); i <= last(upper.x(), region_.size().x()); ++i)
        if (marked(i, j, reach) && shape.signed_distance(p - origin - region_.cell() * Vector2d(i, j)) < -kTouch)
          return true;
  }
  return false;
}

const std::vector<std::uint8_t>& RegionShadow::columns(std::pair<int, int> layers) {
  const auto [it, fresh] = columns_.try_emplace(layers);
  if (fresh)
    for (int j = 0; j < region_.size().y(); ++j)
      for (int i = 0; i < region_.size().x(); ++i) it->second.push_back(marked(i, j, layers));
  return it->second;
}

std::vector<std::uint8_t> RegionShadow::overlapping_cells(const Footprint& footprint, const CellGrid& grid) {
  std::vector<std::uint8_t> out(static_cast<std::size_t>(grid.size()), 0);
  if (region_.count() == 0 || grid.size() == 0) return out;
  const GridCell first = grid.at(0);
  for (const Prism& prism : footprint.prisms) {
    const PlanarShape shape = around_column(prism);
    const std::vector<std::uint8_t>& marks = columns(layers(prism));
    // Columns that lie alike in the grid have the same cells around them: there is one way to lie, or few.
    std::map<std::pair<long, long>, std::vector<Run>> stamps;
    std::size_t k = 0;
    for (int j = 0; j < region_.size().y(); ++j)
      for (int i = 0; i < region_.size().x(); ++i) {
        if (!marks[k++]) continue;
        const Vector2d corner = region_.origin().head<2>() + region_.cell() * Vector2d(i, j);
        const GridCell base = grid.nearest(corner);
        const Vector2d offset = grid.centre(base) - corner;
        const auto [stamp, fresh] = stamps.try_emplace({std::lround(offset.x() * 1e7), std::lround(offset.y() * 1e7)});
        if (fresh) stamp->second = runs_inside(shape, offset, grid.cell());
        for (const Run& run : stamp->second) {
          const int y = base.y + run.row - first.y;
          const int from = std::max(0, base.x + run.first - first.x);
          const int to = std::min(grid.width() - 1, base.x + run.last - first.x);
          if (y < 0 || y >= grid.height() || from > to) continue;
          std::fill_n(out.begin() + y * grid.width() + from, to - from + 1, std::uint8_t{1});
        }
      }
  }
  return out;
}

}  // namespace mamo::mapf
