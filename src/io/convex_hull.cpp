#include "io/convex_hull.hpp"

#include <LinearMath/btConvexHullComputer.h>

#include <numbers>

namespace mamo::io {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "the float64 build of Bullet is the one that is used");

constexpr double kContained = 1e-6;  // m: what sticks out less counts as contained; the grid may add 1e-4 of the extent

struct Plane {
  Eigen::Vector3d normal;  // unit, outward
  double offset;
  double distance(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

Eigen::Vector3d triangle_normal(const ConvexHull& hull, const std::array<int, 3>& t) {
  const auto at = [&](int k) { return hull.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
  return (at(1) - at(0)).cross(at(2) - at(0));
}

std::vector<Plane> planes_of(const ConvexHull& hull) {
  std::vector<Plane> planes;
  for (const auto& t : hull.triangles) {
    const Eigen::Vector3d n = triangle_normal(hull, t);
    const double length = n.norm();
    if (length <= 1e-16) continue;
    const Eigen::Vector3d unit = n / length;
    planes.push_back({unit, unit.dot(hull.vertices[static_cast<std::size_t>(t[0])])});
  }
  return planes;
}

double outside(const std::vector<Plane>& planes, const Eigen::Vector3d& p) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes) largest = std::max(largest, plane.distance(p));
  return largest;
}

/// Volume and centroid as sums of tetrahedra from the mean vertex.
void measure(ConvexHull& hull) {
  Eigen::Vector3d inner = Eigen::Vector3d::Zero();
  for (const auto& v : hull.vertices) inner += v;
  inner /= static_cast<double>(hull.vertices.size());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  hull.volume = 0;
  for (const auto& t : hull.triangles) {
    const Eigen::Vector3d a = hull.vertices[static_cast<std::size_t>(t[0])] - inner;
    const Eigen::Vector3d b = hull.vertices[static_cast<std::size_t>(t[1])] - inner;
    const Eigen::Vector3d c = hull.vertices[static_cast<std::size_t>(t[2])] - inner;
    const double v = a.dot(b.cross(c)) / 6;
    hull.volume += v;
    moment += v * (a + b + c) / 4;
  }
  hull.centroid = hull.volume > 0 ? Eigen::Vector3d(inner + moment / hull.volume) : inner;
}

/// The vertices that are extreme in 26 directions (faces, edges and corners of a cube), in order of index.
std::vector<std::size_t> extremes(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::size_t> chosen;
  for (int k = 0; k < 27; ++k) {
    const Eigen::Vector3d d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (d.isZero()) continue;
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (points[i].dot(d) > points[best].dot(d)) best = i;
    chosen.push_back(best);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

/// Each vertex moved by `distance` along the mean of its faces' normals, weighted by the angle at the vertex.
std::vector<Eigen::Vector3d> offset_vertices(const ConvexHull& hull, double distance) {
  std::vector<Eigen::Vector3d> normals(hull.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& t : hull.triangles) {
    const Eigen::Vector3d n = triangle_normal(hull, t);
    if (n.norm() <= 1e-16) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = hull.vertices[static_cast<std::size_t>(t[k])];
      const Eigen::Vector3d u = hull.vertices[static_cast<std::size_t>(t[(k + 1) % 3])] - p;
      const Eigen::Vector3d v = hull.vertices[static_cast<std::size_t>(t[(k + 2) % 3])] - p;
      normals[static_cast<std::size_t>(t[k])] += n.normalized() * std::atan2(u.cross(v).norm(), u.dot(v));
    }
  }
  std::vector<Eigen::Vector3d> moved = hull.vertices;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (normals[i].norm() > 0) moved[i] += distance * normals[i].normalized();
  return moved;
}

struct Subset {
  ConvexHull hull;
  double loss = 0;  // m: the farthest that a vertex of the original sticks out
};

/// Greedy: the vertex that sticks out most joins, until nothing sticks out by more than the tolerance.
std::optional<Subset> greedy_subset(const ConvexHull& original, const SimplifyOptions& options) {
  std::vector<std::size_t> chosen = extremes(original.vertices);
  while (true) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i : chosen) points.push_back(original.vertices[i]);
    std::optional<ConvexHull> hull = convex_hull(points);
    if (!hull) return std::nullopt;
    const std::vector<Plane> planes = planes_of(*hull);
    std::size_t worst = 0;
    double loss = -1;
    for (std::size_t i = 0; i < original.vertices.size(); ++i)
      if (const double d = outside(planes, original.vertices[i]); d > loss) loss = d, worst = i;
    const int size = static_cast<int>(chosen.size());
    const bool enough = size >= options.last_resort || (size >= options.max_vertices && loss <= options.max_growth / 2);
    const bool stuck = std::find(chosen.begin(), chosen.end(), worst) != chosen.end();
    if (loss <= options.tolerance || enough || stuck) return Subset{std::move(*hull), std::max(loss, 0.0)};
    chosen.push_back(worst);
  }
}

}  // namespace

std::optional<ConvexHull> convex_hull(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) return std::nullopt;
  Eigen::AlignedBox3d box;
  for (const auto& p : points) {
    if (!p.allFinite()) return std::nullopt;
    box.extend(p);
  }
  const double diagonal = box.diagonal().norm();
  if (!(diagonal > 0) || !(diagonal < 1e6)) return std::nullopt;

  btConvexHullComputer computer;
  computer.compute(points[0].data(), sizeof(Eigen::Vector3d), static_cast<int>(points.size()), 0.0, 0.0);
  ConvexHull hull;
  for (int i = 0; i < computer.vertices.size(); ++i) {
    // The grid points, not the points they stand for: only with them are the faces of a dense mesh convex.
    const btVector3& v = computer.vertices[i];
    hull.vertices.emplace_back(v.x(), v.y(), v.z());
  }
  for (int f = 0; f < computer.faces.size(); ++f) {
    const btConvexHullComputer::Edge* const first = &computer.edges[computer.faces[f]];
    const int a = first->getSourceVertex();
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != a; edge = edge->getNextEdgeOfFace())
      hull.triangles.push_back({a, edge->getSourceVertex(), edge->getTargetVertex()});
  }
  if (hull.vertices.size() < 4) return std::nullopt;
  measure(hull);
  if (hull.volume < 0) {
    for (auto& t : hull.triangles) std::swap(t[1], t[2]);
    measure(hull);
  }
  // A volume below that of a sheet of 1e-6 of the extent is rounding, not volume.
  if (!(hull.volume > 1e-8 * std::pow(diagonal, 3))) return std::nullopt;
  return hull;
}

SimplifiedHull simplify(const ConvexHull& original, const SimplifyOptions& options) {
  if (static_cast<int>(original.vertices.size()) <= options.max_vertices) return {original, 0};
  std::optional<Subset> subset = greedy_subset(original, options);
  if (!subset) return {original, 0};

  SimplifiedHull best{subset->hull, subset->loss};
  double distance = subset->loss;
  for (int attempt = 0; attempt < 20; ++attempt) {
    std::optional<ConvexHull> grown = convex_hull(offset_vertices(subset->hull, distance));
    if (!grown) break;
    const std::vector<Plane> planes = planes_of(*grown);
    double excess = 0;
    for (const auto& v : original.vertices) excess = std::max(excess, outside(planes, v));
    best = {std::move(*grown), distance + excess};
    if (excess <= kContained) break;
    distance += 1.1 * excess;
  }
  best.hull.source = original.source;
  best.hull.scale = original.scale;
  return best;
}

}  // namespace mamo::io
