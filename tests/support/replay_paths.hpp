// The joint solution of the object path finding, replayed step by step with geometry of its own: bodies as clouds of
// points and signed distances of the model's shapes, nothing of what the path finder computes with.
#pragma once

#include <map>
#include <set>
#include <sstream>
#include <string>

#include "mamo/collision/voxel_volume.hpp"
#include "mamo/mapf/object_paths.hpp"

namespace mamo::test {

/// Points of a shape's boundary and inside, `spacing` metres apart, and its corners.
inline std::vector<Eigen::Vector3d> cloud_of(const Object& object, double spacing) {
  std::vector<Eigen::Vector3d> out;
  for (const PlacedShape& placed : object.shapes) {
    const Eigen::AlignedBox3d box = bounds(placed.shape, Eigen::Isometry3d::Identity());
    Eigen::Vector3i n = (box.sizes() / spacing).array().ceil().cast<int>();
    n = n.cwiseMax(1);
    for (int i = 0; i <= n.x(); ++i)
      for (int j = 0; j <= n.y(); ++j)
        for (int k = 0; k <= n.z(); ++k) {
          const Eigen::Vector3d p =
              box.min() + box.sizes().cwiseProduct(Eigen::Vector3d(i, j, k).cwiseQuotient(n.cast<double>()));
          if (signed_distance(placed.shape, p) <= 1e-9) out.push_back(placed.X_BS * p);
        }
  }
  return out;
}

/// Metres of the deepest point of either cloud in the other body; 0: they do not overlap (as far as the clouds see).
inline double overlap_depth(const Object& a, const Eigen::Isometry3d& X_WA, const std::vector<Eigen::Vector3d>& cloud_a,
                            const Object& b, const Eigen::Isometry3d& X_WB,
                            const std::vector<Eigen::Vector3d>& cloud_b) {
  const auto bounds_of = [](const Object& o, const Eigen::Isometry3d& X) {
    Eigen::AlignedBox3d box;
    for (const PlacedShape& s : o.shapes) box.extend(bounds(s.shape, X * s.X_BS));
    return box;
  };
  if (!bounds_of(a, X_WA).intersects(bounds_of(b, X_WB))) return 0;
  double deepest = 0;
  const auto look = [&](const std::vector<Eigen::Vector3d>& cloud, const Eigen::Isometry3d& X, const Object& body,
                        const Eigen::Isometry3d& X_WBody) {
    const Eigen::Isometry3d X_BX = X_WBody.inverse() * X;
    for (const Eigen::Vector3d& p : cloud)
      for (const PlacedShape& s : body.shapes)
        deepest = std::max(deepest, -signed_distance(s.shape, s.X_BS.inverse() * (X_BX * p)));
  };
  look(cloud_a, X_WA, b, X_WB);
  look(cloud_b, X_WB, a, X_WA);
  return deepest;
}

/// What is wrong with a solution; empty: nothing. Checks: steps of one cell or none; nobody deeper in anything than
/// `slack` (m) beyond what it was at the start; every centre over a support; everybody clear of the region at the end.
inline std::string replay_error(const Problem& problem, ObjectId target, const WorldState& start,
                                const VoxelVolume& region, const ObjectPathsResult& result, double slack = 0.001,
                                double spacing = 0.02, double cell = 0.01) {
  const Scene& scene = problem.scene;
  std::ostringstream wrong;
  std::vector<std::vector<Eigen::Vector3d>> clouds;
  for (const Object& o : scene.objects)
    clouds.push_back(o.fixture() ? std::vector<Eigen::Vector3d>{} : cloud_of(o, spacing));
  std::map<ObjectId, const ObjectPath*> path_of;
  std::size_t steps = 0;
  for (const ObjectPath& path : result.paths) {
    path_of[path.object] = &path;
    steps = std::max(steps, path.cells.size());
    if (path.cells.size() < 2 || path.points.size() < 2 || path.goal != path.cells.back())
      wrong << "path without length of " << scene[path.object].id << "; ";
    for (std::size_t t = 0; t + 1 < path.cells.size(); ++t)
      if (std::abs(path.cells[t].x - path.cells[t + 1].x) + std::abs(path.cells[t].y - path.cells[t + 1].y) > 1)
        wrong << "a jump of " << scene[path.object].id << " at " << t << "; ";
  }
  const auto pose = [&](ObjectId id, std::size_t t) {
    Eigen::Isometry3d X = id == target || !scene[id].movable() ? scene[id].X_WO : start.X_WO(id);
    if (const auto it = path_of.find(id); it != path_of.end()) {
      const GridCell c = it->second->cells[std::min(t, it->second->cells.size() - 1)];
      if (c != it->second->cells[0]) X.translation().head<2>() << c.x * cell, c.y * cell;
    }
    return X;
  };
  const auto depth = [&](ObjectId a, ObjectId b, std::size_t t) {
    return overlap_depth(scene[a], pose(a, t), clouds[a.index()], scene[b], pose(b, t), clouds[b.index()]);
  };
  for (const auto& [id, path] : path_of)
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const ObjectId other(i);
      if (other == id || (path_of.contains(other) && other < id)) continue;
      const bool stands_on = scene[other].constraints.touch == Touch::support;
      const double at_start = stands_on ? 0 : depth(id, other, 0);
      for (std::size_t t = 1; t < steps && !stands_on; ++t)
        if (const double d = depth(id, other, t); d > at_start + slack)
          wrong << scene[id].id << " is " << d << " m deep in " << scene[other].id << " at " << t << "; ";
    }
  for (const auto& [id, path] : path_of)
    for (std::size_t t = 1; t < path->cells.size(); ++t) {
      bool supported = path->cells[t] == path->cells[0];
      const Eigen::Vector3d p = pose(id, t).translation();
      for (const Object& o : scene.objects)
        if (o.constraints.touch == Touch::support)
          for (const PlacedShape& s : o.shapes) {
            const Eigen::AlignedBox3d box = bounds(s.shape, o.X_WO * s.X_BS);
            supported =
                supported || ((p - box.min()).head<2>().minCoeff() > 0 && (box.max() - p).head<2>().minCoeff() > 0);
          }
      if (!supported) wrong << scene[id].id << " leaves the support at " << t << "; ";
    }
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (const ObjectId id(i); scene[id].movable() && id != target)
      if (region.overlap(scene[id], pose(id, steps)).common_cells > 0) wrong << scene[id].id << " ends in the region; ";
  return wrong.str();
}

}  // namespace mamo::test
