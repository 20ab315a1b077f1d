#include "view/triangles.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

namespace mamo::view {
namespace {

TriangleMesh box_mesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.emplace_back(size.x() * (corner & 1 ? 0.5 : -0.5), size.y() * (corner & 2 ? 0.5 : -0.5),
                               size.z() * (corner & 4 ? 0.5 : -0.5));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double length, int sides) {
  TriangleMesh mesh;
  for (int k = 0; k < sides; ++k) {
    const double a = 2 * std::numbers::pi * k / sides;
    for (double z : {-length / 2, length / 2})
      mesh.vertices.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
  }
  mesh.vertices.emplace_back(0, 0, -length / 2);
  mesh.vertices.emplace_back(0, 0, length / 2);
  const int below = 2 * sides, above = below + 1;
  for (int k = 0; k < sides; ++k) {
    const int a = 2 * k, b = 2 * ((k + 1) % sides);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
    mesh.triangles.push_back({below, b, a});
    mesh.triangles.push_back({above, a + 1, b + 1});
  }
  return mesh;
}

TriangleMesh sphere_mesh(double radius, int sides) {
  TriangleMesh mesh;
  const int rings = sides / 2;
  for (int r = 0; r <= rings; ++r)
    for (int k = 0; k < sides; ++k) {
      const double polar = std::numbers::pi * r / rings, a = 2 * std::numbers::pi * k / sides;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(a), radius * std::sin(polar) * std::sin(a),
                                 radius * std::cos(polar));
    }
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < sides; ++k) {
      const int a = r * sides + k, b = r * sides + (k + 1) % sides;
      if (r > 0) mesh.triangles.push_back({a, a + sides, b});
      if (r + 1 < rings) mesh.triangles.push_back({b, a + sides, b + sides});
    }
  return mesh;
}

using Cell = std::array<std::int64_t, 3>;

TriangleMesh merge_in_cells(const TriangleMesh& mesh, double cell) {
  TriangleMesh out;
  std::map<Cell, int> index_of;
  std::vector<int> index(mesh.vertices.size());
  std::vector<int> count;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector3d p = mesh.vertices[v] / cell;
    const auto [at, added] = index_of.emplace(Cell{std::llround(p.x()), std::llround(p.y()), std::llround(p.z())},
                                              static_cast<int>(out.vertices.size()));
    if (added) out.vertices.push_back(Eigen::Vector3d::Zero()), count.push_back(0);
    index[v] = at->second;
    out.vertices[static_cast<std::size_t>(at->second)] += mesh.vertices[v];
    ++count[static_cast<std::size_t>(at->second)];
  }
  for (std::size_t v = 0; v < out.vertices.size(); ++v) out.vertices[v] /= count[v];
  std::set<std::array<int, 3>> seen;
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> merged{};
    for (std::size_t i = 0; i < 3; ++i) merged[i] = index[static_cast<std::size_t>(t[i])];
    if (merged[0] == merged[1] || merged[1] == merged[2] || merged[2] == merged[0]) continue;
    std::rotate(merged.begin(), std::min_element(merged.begin(), merged.end()), merged.end());
    if (seen.insert(merged).second) out.triangles.push_back(merged);
  }
  return out;
}

}  // namespace

TriangleMesh tessellate(const Shape& shape, int sides) {
  if (const Box* box = std::get_if<Box>(&shape)) return box_mesh(box->size);
  if (const Cylinder* c = std::get_if<Cylinder>(&shape)) return cylinder_mesh(c->radius, c->length, sides);
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return sphere_mesh(sphere->radius, sides);
  const ConvexHull& hull = *std::get<Mesh>(shape).hull;
  return {hull.vertices, hull.triangles};
}

TriangleMesh reduce(const TriangleMesh& mesh, std::size_t most) {
  // The corners of a mesh are rarely shared: half a millimetre joins them and changes nothing one sees.
  TriangleMesh out = merge_in_cells(mesh, 5e-4);
  for (double cell = 1e-3; out.triangles.size() > most && cell < 0.5; cell *= 1.4) out = merge_in_cells(mesh, cell);
  return out;
}

std::string VisualMeshes::key(const VisualGeometry& visual) {
  std::ostringstream text;
  text << visual.mesh_path << ' ' << visual.scale.transpose();
  return text.str();
}

VisualMeshes::VisualMeshes(const RobotModel& robot, std::size_t budget) {
  std::map<std::string, TriangleMesh> full;
  std::size_t total = 0;
  for (const Link& link : robot.links)
    for (const VisualGeometry& visual : link.visual) {
      if (visual.mesh_path.empty() || full.contains(key(visual))) continue;
      Result<TriangleMesh> mesh = io::load_triangles(visual.mesh_path, visual.scale);
      if (!mesh.ok()) continue;
      total += mesh->triangles.size();
      full.emplace(key(visual), std::move(*mesh));
    }
  for (const auto& [name, mesh] : full) {
    const double share = std::min(1.0, static_cast<double>(budget) / static_cast<double>(total));
    const auto most = static_cast<std::size_t>(share * static_cast<double>(mesh.triangles.size()));
    meshes_.emplace(name, reduce(mesh, std::max<std::size_t>(most, 60)));
  }
}

const TriangleMesh* VisualMeshes::find(const VisualGeometry& visual) const {
  const auto found = meshes_.find(key(visual));
  return found == meshes_.end() ? nullptr : &found->second;
}

}  // namespace mamo::view
