#include "view/raster.hpp"

#include <Eigen/Geometry>
#include <png.h>

#include <string>

namespace mamo::view {
namespace {

/// Rows: right, down, forward.
Eigen::Matrix4d looking(const Eigen::Vector3d& eye, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d f = forward.normalized();
  Eigen::Vector3d right = f.cross(Eigen::Vector3d::UnitZ());
  right = right.norm() > 1e-6 ? right.normalized() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d down = f.cross(right);
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.row(0).head<3>() = right;
  M.row(1).head<3>() = down;
  M.row(2).head<3>() = f;
  M.col(3).head<3>() = -(M.topLeftCorner<3, 3>() * eye);
  return M;
}

}  // namespace

Projection Projection::perspective(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double fov, int width,
                                   int height) {
  const double focal = height / 2.0 / std::tan(fov / 2);
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  K.row(0) << focal, 0, width / 2.0, 0;
  K.row(1) << 0, focal, height / 2.0, 0;
  K.row(2) << 0, 0, 1, -2 * kNear;  // depth grows with distance and is linear in the picture
  K.row(3) << 0, 0, 1, 0;
  return {K * looking(eye, target - eye)};
}

Projection Projection::parallel(const Eigen::Vector3d& target, const Eigen::Vector3d& direction, double reach,
                                int size) {
  Eigen::Matrix4d K = Eigen::Matrix4d::Identity();
  K(0, 0) = K(1, 1) = size / reach;
  K(0, 3) = K(1, 3) = size / 2.0;
  return {K * looking(target, direction)};
}

std::string png_bytes(const std::vector<std::uint8_t>& rgb, int width, int height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  if (!png_image_write_to_memory(&image, nullptr, &size, 0, rgb.data(), 0, nullptr)) return "";
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr)) return "";
  bytes.resize(size);
  return bytes;
}

}  // namespace mamo::view
