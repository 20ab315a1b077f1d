// Triangles to pixels: a projection, a depth buffer, one call per pixel that is covered.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace mamo::view {

/// World to pixels: x to the right, y down. Points with w below kNear are behind the eye.
struct Projection {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();  // world to homogeneous (x px * w, y px * w, depth * w, w)
  static constexpr double kNear = 0.02;             // m

  /// Looking from `eye` at `target`, z up in the picture; fov: vertical (rad).
  static Projection perspective(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double fov, int width,
                                int height);
  /// Parallel light along `direction`; a square of `reach` m around `target` fills size x size pixels.
  static Projection parallel(const Eigen::Vector3d& target, const Eigen::Vector3d& direction, double reach, int size);

  Eigen::Vector4d operator()(const Eigen::Vector3d& p) const { return M * p.homogeneous(); }
};

/// Calls pixel(x, y, depth, weights) for every pixel whose centre the triangle covers: smaller depth is nearer, weights
/// are those of the three corners in world.
template <class Pixel>
void rasterise(const Projection& projection, const std::array<Eigen::Vector3d, 3>& corners, int width, int height,
               Pixel&& pixel) {
  struct Vertex {
    Eigen::Vector4d clip;
    Eigen::Vector3d weights;
  };
  std::array<Vertex, 4> polygon;
  int count = 0;
  for (int i = 0; i < 3; ++i) {  // cut off what is behind the eye
    const int j = (i + 1) % 3;
    const Vertex a{projection(corners[static_cast<std::size_t>(i)]), Eigen::Vector3d::Unit(i)};
    const Vertex b{projection(corners[static_cast<std::size_t>(j)]), Eigen::Vector3d::Unit(j)};
    const double wa = a.clip.w() - Projection::kNear, wb = b.clip.w() - Projection::kNear;
    if (wa >= 0) polygon[static_cast<std::size_t>(count++)] = a;
    if ((wa >= 0) == (wb >= 0)) continue;
    const double s = wa / (wa - wb);
    polygon[static_cast<std::size_t>(count++)] = {a.clip + s * (b.clip - a.clip),
                                                  a.weights + s * (b.weights - a.weights)};
  }
  for (int k = 2; k < count; ++k) {
    const std::array<const Vertex*, 3> v = {&polygon[0], &polygon[static_cast<std::size_t>(k - 1)],
                                            &polygon[static_cast<std::size_t>(k)]};
    std::array<Eigen::Vector3d, 3> s;  // x px, y px, depth
    for (std::size_t i = 0; i < 3; ++i) s[i] = v[i]->clip.hnormalized();
    const double area = (s[1] - s[0]).x() * (s[2] - s[0]).y() - (s[2] - s[0]).x() * (s[1] - s[0]).y();
    if (std::abs(area) < 1e-9) continue;
    const auto low = [&](int axis) { return std::min({s[0][axis], s[1][axis], s[2][axis]}); };
    const auto high = [&](int axis) { return std::max({s[0][axis], s[1][axis], s[2][axis]}); };
    const int x0 = std::max(0, static_cast<int>(std::floor(std::max(low(0), 0.0)))),
              x1 = std::min(width - 1, static_cast<int>(std::ceil(std::min(high(0), width * 1.0))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::max(low(1), 0.0)))),
              y1 = std::min(height - 1, static_cast<int>(std::ceil(std::min(high(1), height * 1.0))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2d p(x + 0.5, y + 0.5);
        const auto edge = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
          return ((b - a).x() * (p.y() - a.y()) - (p.x() - a.x()) * (b - a).y()) / area;
        };
        const Eigen::Vector3d share(edge(s[1], s[2]), edge(s[2], s[0]), edge(s[0], s[1]));
        if (share.minCoeff() < 0) continue;
        Eigen::Vector3d weights = Eigen::Vector3d::Zero();
        double depth = 0, over_w = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double w = share[static_cast<Eigen::Index>(i)] / v[i]->clip.w();
          weights += w * v[i]->weights;
          over_w += w;
          depth += share[static_cast<Eigen::Index>(i)] * s[i].z();
        }
        pixel(x, y, depth, Eigen::Vector3d(weights / over_w));
      }
  }
}

/// 8-bit RGB rows as PNG. Empty when the library refuses.
std::string png_bytes(const std::vector<std::uint8_t>& rgb, int width, int height);

}  // namespace mamo::view
