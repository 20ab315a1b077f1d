// Mesh files (STL, OBJ, COLLADA) as convex hulls, and as they are for people to look at.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/model/shape.hpp"

namespace mamo::io {

struct LoadedHull {
  std::shared_ptr<const ConvexHull> hull;
  /// m. Hulls of more than 64 vertices are replaced by smaller ones (at most 96) that contain them; their surface
  /// lies at most this far outside. Up to 1 mm is usual, beyond that callers warn.
  double growth = 0;
};

/// The convex hull of every triangle of a file, scaled. The extension says the format, in any case. COLLADA: the
/// unit of the file counts, its up axis does not (as in ROS: a robot's frames are those of the URDF). Errors name
/// the file: missing, too large, unreadable, no triangles, no volume, a coordinate that is not finite.
Result<LoadedHull> load_hull(const std::string& path, const Eigen::Vector3d& scale);

/// The surface itself, for view only. Corners are not shared between the meshes of a file.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;      // m, scaled
  std::vector<std::array<int, 3>> triangles;  // indices into vertices
};
/// Reads and refuses what load_hull() does, but needs no volume. Polygons become triangles.
Result<TriangleMesh> load_triangles(const std::string& path, const Eigen::Vector3d& scale);

}  // namespace mamo::io
