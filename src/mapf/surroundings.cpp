#include "mapf/surroundings.hpp"

#include <algorithm>
#include <limits>

namespace mamo::mapf {
namespace {

using Eigen::Vector2d;

constexpr double kFloor = 1e-9;  // m: strictly inside
/// Supports whose tops differ by less are one surface, and objects sink in by less (m).
constexpr double kSameHeight = 0.01;
/// How far beyond the objects the grid goes (m).
constexpr double kMargin = 1.0;

PlanarShape shifted(const PlanarShape& shape, const Vector2d& by) {
  std::vector<Vector2d> points = shape.vertices();
  for (Vector2d& p : points) p += by;
  return {std::move(points), shape.radius()};
}

}  // namespace

CellGrid::CellGrid(const Vector2d& lower, const Vector2d& upper, double cell) : cell_(cell) {
  first_ = {static_cast<std::int32_t>(std::ceil(lower.x() / cell)),
            static_cast<std::int32_t>(std::ceil(lower.y() / cell))};
  width_ = std::max(0, static_cast<std::int32_t>(std::floor(upper.x() / cell)) - first_.x + 1);
  height_ = std::max(0, static_cast<std::int32_t>(std::floor(upper.y() / cell)) - first_.y + 1);
}

GridCell CellGrid::nearest(const Vector2d& p) const {
  return {static_cast<std::int32_t>(std::lround(p.x() / cell_)), static_cast<std::int32_t>(std::lround(p.y() / cell_))};
}

bool Surroundings::supported(const Vector2d& p) const {
  return !supports || std::any_of(supports->begin(), supports->end(),
                                  [&](const PlanarShape& s) { return s.signed_distance(p) < -kFloor; });
}

Stage::Stage(const Scene& scene, ObjectId target, const ObjectPathsOptions& options) : clearance_(options.clearance) {
  Vector2d lower = Vector2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  Vector2d support_lower = lower, support_upper = upper;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Object& object = scene.objects[i];
    const Vector2d p = object.X_WO.translation().head<2>();
    if (!object.fixture()) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
    if (object.movable() && ObjectId(i) != target) continue;
    stills_.push_back({ObjectId(i), footprint_of(object, object.X_WO), p});
    if (!object.fixture() || object.constraints.touch != Touch::support) continue;
    for (const Prism& prism : stills_.back().footprint.prisms) {
      const auto same = std::find_if(levels_.begin(), levels_.end(),
                                     [&](const Level& l) { return std::abs(l.top - prism.high) < kSameHeight; });
      Level& level = same != levels_.end() ? *same : levels_.emplace_back(Level{prism.high, {}});
      level.areas.push_back(shifted(prism.shadow, p));
      support_lower = support_lower.cwiseMin(level.areas.back().lower());
      support_upper = support_upper.cwiseMax(level.areas.back().upper());
    }
  }
  std::sort(levels_.begin(), levels_.end(), [](const Level& a, const Level& b) { return a.top < b.top; });
  if (!(lower.array() <= upper.array()).all()) lower.setZero(), upper.setZero();
  lower.array() -= kMargin;
  upper.array() += kMargin;
  if (!levels_.empty()) lower = lower.cwiseMax(support_lower), upper = upper.cwiseMin(support_upper);
  grid_ = CellGrid(lower, upper, options.cell);
}

int Stage::level_of(const Footprint& footprint, const Vector2d& p) const {
  if (levels_.empty()) return 0;  // the floor
  int any = -1;
  for (int l = static_cast<int>(levels_.size()) - 1; l >= 0; --l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    if (level.top > footprint.low + kSameHeight) continue;
    for (const PlanarShape& area : level.areas)
      if (area.signed_distance(p) < 0) return l;
    any = std::max(any, l);
  }
  return any;
}

Surroundings Stage::surroundings(const Footprint& footprint, int level) const {
  Surroundings out;
  if (!levels_.empty()) out.supports = &levels_[static_cast<std::size_t>(level)].areas;
  for (const Still& still : stills_) {
    Obstacle o{still.object, {}, {}, {}};
    for (const PlanarShape& s : obstacle_shapes(still.footprint, footprint)) o.shapes.push_back(shifted(s, still.p));
    if (o.shapes.empty()) continue;
    o.lower = o.shapes[0].lower(), o.upper = o.shapes[0].upper();
    for (const PlanarShape& s : o.shapes) o.lower = o.lower.cwiseMin(s.lower()), o.upper = o.upper.cwiseMax(s.upper());
    out.obstacles.push_back(std::move(o));
  }
  std::vector<double> distance(static_cast<std::size_t>(grid_.size()), std::numeric_limits<double>::infinity());
  const auto index = [](double v, int low, int high) { return std::clamp(static_cast<int>(v), low, high); };
  const GridCell first = grid_.size() > 0 ? grid_.at(0) : GridCell{};
  for (const Obstacle& o : out.obstacles) {
    const Vector2d lower = (o.lower.array() - clearance_) / grid_.cell(),
                   upper = (o.upper.array() + clearance_) / grid_.cell();
    for (int y = index(std::floor(lower.y()) - first.y, 0, grid_.height());
         y < index(std::ceil(upper.y()) - first.y + 1, 0, grid_.height()); ++y)
      for (int x = index(std::floor(lower.x()) - first.x, 0, grid_.width());
           x < index(std::ceil(upper.x()) - first.x + 1, 0, grid_.width()); ++x) {
        double& d = distance[static_cast<std::size_t>(y * grid_.width() + x)];
        if (d >= 0) d = std::min(d, o.distance(grid_.centre({first.x + x, first.y + y})));
      }
  }
  out.cost.resize(distance.size());
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double d = distance[i];
    if (d < -kFloor || !out.supported(grid_.centre(grid_.at(static_cast<std::int32_t>(i)))))
      out.cost[i] = Surroundings::kBlocked;
    else
      out.cost[i] = d > clearance_ ? 0 : static_cast<std::uint8_t>(std::pow(10.0, 1.0 - std::max(0.0, d) / clearance_));
  }
  return out;
}

}  // namespace mamo::mapf
