#include "verify/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verify/solid.hpp"

namespace mamo::verify {
namespace {

constexpr double kTouching = 0.001;  // m: bodies closer than this at the start touch
constexpr double kSunk = 0.001;      // m: what contact solving lets a body sink in without having left
constexpr int kRimPoints = 96;       // of a circle seen from above; misses 0.05 % of the radius
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Andrew's monotone chain, counter-clockwise.
std::vector<Eigen::Vector2d> convex_outline(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the next side starts with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<Eigen::Vector3d> extreme_points(const Shape& shape) {
  std::vector<Eigen::Vector3d> points;
  if (const Box* box = std::get_if<Box>(&shape)) {
    for (int corner = 0; corner < 8; ++corner)
      points.emplace_back(box->size.x() * (corner & 1 ? 0.5 : -0.5), box->size.y() * (corner & 2 ? 0.5 : -0.5),
                          box->size.z() * (corner & 4 ? 0.5 : -0.5));
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape)) {
    for (int k = 0; k < kRimPoints; ++k) {
      const double a = 2 * std::numbers::pi * k / kRimPoints;
      for (double z : {-cylinder->length / 2, cylinder->length / 2})
        points.emplace_back(cylinder->radius * std::cos(a), cylinder->radius * std::sin(a), z);
    }
  } else if (const Mesh* mesh = std::get_if<Mesh>(&shape)) {
    points = mesh->hull->vertices;
  }
  return points;
}

}  // namespace

std::set<std::pair<ObjectId, ObjectId>> pairs_in_contact(const Problem& problem, const ForwardKinematics& kinematics) {
  const Scene& scene = problem.scene;
  std::set<std::pair<ObjectId, ObjectId>> pairs;
  std::vector<std::vector<Solid>> bodies, grown;
  for (const Object& object : scene.objects) {
    bodies.push_back(solids_of(object.shapes));
    grown.push_back(solids_of(object.shapes, kTouching));
    place(bodies.back(), object.X_WO);
    place(grown.back(), object.X_WO);
  }
  for (std::size_t a = 0; a < scene.size(); ++a)
    for (std::size_t b = a + 1; b < scene.size(); ++b)
      if (!(scene.objects[a].fixture() && scene.objects[b].fixture()) && overlap(grown[a], bodies[b]))
        pairs.emplace(ObjectId(a), ObjectId(b));

  const std::vector<bool> moving = problem.robot.moving_links();
  std::vector<Eigen::Isometry3d> X_WL;
  kinematics.link_poses(problem.q_start, X_WL);
  for (std::size_t l = 0; l < moving.size(); ++l) {
    if (moving[l]) continue;
    std::vector<Solid> link = solids_of(problem.robot.model->links[l].collision);
    place(link, X_WL[l]);
    for (std::size_t b = 0; b < scene.size(); ++b)
      if (overlap(link, grown[b])) pairs.emplace(kRobot, ObjectId(b));
  }
  return pairs;
}

Support::Footprint Support::footprint(const PlacedShape& shape, const Eigen::Isometry3d& X_WO) {
  const Eigen::Isometry3d X_WS = X_WO * shape.X_BS;
  Footprint print;
  print.bottom = bounds(shape.shape, X_WS).min().z();
  std::vector<Eigen::Vector2d> points;
  if (const Sphere* sphere = std::get_if<Sphere>(&shape.shape)) {
    for (int k = 0; k < kRimPoints; ++k) {
      const double a = 2 * std::numbers::pi * k / kRimPoints;
      points.push_back(X_WS.translation().head<2>() + sphere->radius * Eigen::Vector2d(std::cos(a), std::sin(a)));
    }
  }
  for (const Eigen::Vector3d& p : extreme_points(shape.shape)) points.push_back((X_WS * p).head<2>());
  print.outline = convex_outline(std::move(points));
  return print;
}

double Support::outside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point) {
  bool inside = outline.size() >= 3;
  double nearest = kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Eigen::Vector2d edge = b - a;
    if (cross(edge, point - a) < 0) inside = false;
    const double s = edge.squaredNorm() > 0 ? std::clamp(edge.dot(point - a) / edge.squaredNorm(), 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + s * edge - point).norm());
  }
  return inside ? 0 : nearest;
}

Support::Support(const Scene& scene, const std::set<std::pair<ObjectId, ObjectId>>& touching) : scene_(scene) {
  start_.resize(scene.size());
  fixtures_.resize(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Object& object = scene.objects[i];
    if (object.fixture())
      for (const PlacedShape& shape : object.shapes) fixtures_[i].push_back(footprint(shape, object.X_WO));
    start_[i].top = -kInfinity;
  }
  // Under an object is a shape that touches it and whose top is not above its centre of mass.
  const auto note = [&](ObjectId upper, ObjectId lower) {
    if (scene[upper].fixture()) return;
    const double centre = (scene[upper].X_WO * scene[upper].centre_of_mass()).z();
    std::vector<Solid> grown = solids_of(scene[upper].shapes, kTouching);
    place(grown, scene[upper].X_WO);
    bool carries = false;
    for (const PlacedShape& shape : scene[lower].shapes) {
      const double top = bounds(shape.shape, scene[lower].X_WO * shape.X_BS).max().z();
      std::vector<Solid> solid = solids_of({shape});
      place(solid, scene[lower].X_WO);
      if (top > centre || !overlap(grown, solid)) continue;
      carries = true;
      double& lowest = start_[upper.index()].top;
      lowest = std::isinf(lowest) ? top : std::min(lowest, top);
    }
    if (carries) start_[upper.index()].bodies.push_back(lower);
  };
  for (const auto& [a, b] : touching) {
    if (!a.valid()) continue;
    note(a, b);
    note(b, a);
  }
}

double Support::left_by(ObjectId id, const Eigen::Vector3d& centre, const std::vector<Eigen::Isometry3d>& X_WO) const {
  const Start& start = start_[id.index()];
  const double below = start.top - kSunk - centre.z();
  double beside = kInfinity;
  const auto offer = [&](const Footprint& print) {
    if (print.bottom < centre.z()) beside = std::min(beside, outside(print.outline, centre.head<2>()));
  };
  for (std::size_t i = 0; i < scene_.size(); ++i) {
    if (!scene_.objects[i].fixture()) continue;
    const bool carried = std::find(start.bodies.begin(), start.bodies.end(), ObjectId(i)) != start.bodies.end();
    if (scene_.objects[i].constraints.touch != Touch::support && !carried) continue;
    for (const Footprint& print : fixtures_[i]) offer(print);
  }
  for (ObjectId lower : start.bodies) {
    if (scene_[lower].fixture()) continue;
    for (const PlacedShape& shape : scene_[lower].shapes) offer(footprint(shape, X_WO[lower.index()]));
  }
  if (below > 0) return std::isinf(beside) ? below : std::max(below, beside);
  return std::isinf(beside) ? 0 : beside;
}

}  // namespace mamo::verify
