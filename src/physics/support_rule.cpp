#include "physics/support_rule.hpp"

#include <algorithm>
#include <limits>

namespace mamo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// What contact solving lets a body sink into its support (m).
constexpr double kSink = 0.001;

/// How far (m) the vertical line through p passes beside the shape; 0 if it meets the shape below p. Outside of
/// the shape the distance is that to its bounds, which is enough to report.
double beside(const PlacedShape& placed, const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& p) {
  const Eigen::Isometry3d X_WS = X_WB * placed.X_BS;
  const Eigen::AlignedBox3d box = bounds(placed.shape, X_WS);
  if (box.min().z() >= p.z()) return kInfinity;
  const Eigen::Vector2d d = (box.min().head<2>() - p.head<2>()).cwiseMax(p.head<2>() - box.max().head<2>()).cwiseMax(0.0);
  if (d.norm() > 0) return d.norm();
  // Convex: the distance along the line has one minimum, so a ternary search finds whether it dips below zero.
  double lo = box.min().z(), hi = std::min(box.max().z(), p.z());
  const Eigen::Isometry3d X_SW = X_WS.inverse();
  const auto distance = [&](double z) {
    return signed_distance(placed.shape, X_SW * Eigen::Vector3d(p.x(), p.y(), z));
  };
  for (int i = 0; i < 60; ++i) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    const double at_a = distance(a), at_b = distance(b);
    if (at_a <= 0 || at_b <= 0) return 0;
    (at_a < at_b ? hi : lo) = at_a < at_b ? b : a;
  }
  return std::max(0.0, distance((lo + hi) / 2));
}

double top_of(const Object& o) {
  double top = -kInfinity;
  for (const PlacedShape& s : o.shapes) top = std::max(top, bounds(s.shape, o.X_WO * s.X_BS).max().z());
  return top;
}

}  // namespace

SupportRule::SupportRule(const Scene& scene, const std::vector<std::pair<ObjectId, ObjectId>>& touching)
    : scene_(scene), start_(scene.size(), Start{{}, kInfinity}) {
  const auto note = [&](ObjectId upper, ObjectId lower) {
    if (!upper.valid() || !lower.valid() || scene[upper].fixture()) return;
    const double top = top_of(scene[lower]);
    if (top > (scene[upper].X_WO * scene[upper].centre_of_mass()).z()) return;
    Start& s = start_[upper.index()];
    s.stood_on.push_back(lower);
    s.top = std::min(s.top, top);
  };
  for (const auto& [a, b] : touching) {
    note(a, b);
    note(b, a);
  }
  for (Start& s : start_) {
    std::sort(s.stood_on.begin(), s.stood_on.end());
    if (s.stood_on.empty()) s.top = -kInfinity;
  }
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scene.objects[i].fixture() && scene.objects[i].constraints.touch == Touch::support)
      supporting_fixtures_.emplace_back(i);
}

double SupportRule::left_by(ObjectId id, const Eigen::Vector3d& p,
                            const std::function<Eigen::Isometry3d(ObjectId)>& X_WO) const {
  const Start& start = start_[id.index()];
  const double below = start.top - kSink - p.z();
  double nearest = kInfinity;
  const auto offer = [&](ObjectId support) {
    const Object& o = scene_[support];
    const Eigen::Isometry3d X = o.fixture() ? o.X_WO : X_WO(support);
    for (const PlacedShape& s : o.shapes) nearest = std::min(nearest, beside(s, X, p));
  };
  for (const ObjectId support : supporting_fixtures_)
    if (nearest > 0) offer(support);
  for (const ObjectId support : start.stood_on)
    if (nearest > 0) offer(support);
  if (nearest == kInfinity) nearest = std::max(below, std::abs(p.z()));  // nothing below that could carry it
  return std::max({below, nearest, 0.0});
}

}  // namespace mamo
