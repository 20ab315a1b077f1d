#include "hull_offset.hpp"

namespace mamo::collision {
namespace {

/// Outward unit normals of the faces around each vertex.
std::vector<std::vector<Eigen::Vector3d>> normals_by_vertex(const ConvexHull& hull) {
  std::vector<std::vector<Eigen::Vector3d>> normals(hull.vertices.size());
  for (const auto& t : hull.triangles) {
    const Eigen::Vector3d& a = hull.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d n =
        (hull.vertices[static_cast<std::size_t>(t[1])] - a).cross(hull.vertices[static_cast<std::size_t>(t[2])] - a);
    if (n.norm() <= 0) continue;
    for (int v : t) normals[static_cast<std::size_t>(v)].push_back(n.normalized());
  }
  return normals;
}

/// A short vector u with n.u >= 1 for all normals: the axis of their cap, by moving it again and again towards the
/// normal furthest from it (Badoiu and Clarkson 2003). The zero vector if they fit in no half space.
Eigen::Vector3d outward(const std::vector<Eigen::Vector3d>& normals) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& n : normals) centre += n;
  centre /= std::max<double>(1.0, static_cast<double>(normals.size()));
  const auto worst = [&](const Eigen::Vector3d& d) {
    const Eigen::Vector3d* found = &normals.front();
    for (const auto& n : normals)
      if (n.dot(d) < found->dot(d)) found = &n;
    return *found;
  };
  if (normals.empty()) return centre;
  for (int k = 1; k <= 200; ++k) centre += (worst(centre) - centre) / (k + 1.0);
  const double least = worst(centre).dot(centre);
  return least > 1e-3 * centre.norm() ? Eigen::Vector3d(centre / least) : Eigen::Vector3d::Zero();
}

}  // namespace

// Why the hull of v + distance * u_v holds the grown body: a direction d that vertex v is extreme in is a
// non-negative sum of v's face normals n_f, so d.(v + distance u_v) = sum l_f n_f.(v + distance u_v) >= sum l_f (h_f +
// distance) >= d.(v + distance d/|d|).
std::vector<Eigen::Vector3d> offset_vertices(const ConvexHull& hull, double distance) {
  std::vector<Eigen::Vector3d> out = hull.vertices;
  if (distance == 0) return out;
  const auto normals = normals_by_vertex(hull);
  if (distance > 0) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Eigen::Vector3d u = outward(normals[i]);
      if (u != Eigen::Vector3d::Zero()) {
        out[i] += distance * u;
      } else {  // a degenerate corner: the corners of a cube hold every direction
        for (int corner = 0; corner < 8; ++corner)
          out.push_back(hull.vertices[i] +
                        distance * Eigen::Vector3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
      }
    }
    return out;
  }
  // Shrinking: every vertex towards the centroid until all faces have come nearer to it by the distance.
  double thickness = std::numeric_limits<double>::infinity();  // from the centroid to the nearest face
  for (std::size_t i = 0; i < out.size(); ++i)
    for (const auto& n : normals[i]) thickness = std::min(thickness, n.dot(hull.vertices[i] - hull.centroid));
  const double scale = std::max(0.0, 1.0 + distance / std::max(thickness, 1e-9));
  for (auto& v : out) v = hull.centroid + scale * (v - hull.centroid);
  return out;
}

}  // namespace mamo::collision
