#include "view/geometry_table.hpp"

#include <algorithm>
#include <cmath>

#include "view/series.hpp"

namespace mamo::view {
namespace {

using Json = nlohmann::json;

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

template <class Int>
void put(std::vector<std::uint8_t>& bytes, Int value) {  // little-endian, as every browser reads it
  for (std::size_t i = 0; i < sizeof(Int); ++i)
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
}

Json surface(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const Eigen::Vector3d size = box.sizes().cwiseMax(1e-9);
  std::vector<std::uint8_t> points, corners;
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int i = 0; i < 3; ++i)
      put(points, static_cast<std::uint16_t>(std::lround((p[i] - box.min()[i]) / size[i] * 65535)));
  const bool wide = mesh.vertices.size() > 65535;
  for (const auto& triangle : mesh.triangles)
    for (int v : triangle)
      wide ? put(corners, static_cast<std::uint32_t>(v)) : put(corners, static_cast<std::uint16_t>(v));
  return {{"type", "mesh"},           {"low", point_json(box.min())}, {"size", point_json(size)},
          {"points", base64(points)}, {"corners", base64(corners)},   {"wide", wide}};
}

}  // namespace

Json point_json(const Eigen::Vector3d& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }

Json pose_json(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  const Eigen::Vector3d& p = X.translation();
  return {rounded(p.x()), rounded(p.y()), rounded(p.z()), rounded(q.x()),
          rounded(q.y()), rounded(q.z()), rounded(q.w())};
}

std::size_t GeometryTable::put(Json entry) {
  const auto [at, added] = index_of_.emplace(entry.dump(), table_.size());
  if (added) table_.push_back(std::move(entry));
  return at->second;
}

std::size_t GeometryTable::add(const Shape& shape) {
  if (const Box* box = std::get_if<Box>(&shape)) return put({{"type", "box"}, {"size", point_json(box->size)}});
  if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    return put({{"type", "cylinder"}, {"radius", c->radius}, {"length", c->length}});
  if (const Sphere* s = std::get_if<Sphere>(&shape)) return put({{"type", "sphere"}, {"radius", s->radius}});
  return put(surface(tessellate(shape)));
}

std::size_t GeometryTable::add(const TriangleMesh& mesh) { return put(surface(mesh)); }

}  // namespace mamo::view
