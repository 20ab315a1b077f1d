#include "mamo/collision/voxel_volume.hpp"

#include <cmath>

namespace mamo {
namespace {

/// Calls visit(index, centre) for the cells of interest(index) whose centre is no further than `margin` from the shape.
template <class Interest, class Visit>
void for_cells(const Shape& shape, const Eigen::Isometry3d& X_WS, const Eigen::Vector3d& origin, double cell,
               double margin, const Eigen::Vector3i& least, const Eigen::Vector3i& most, Interest interest,
               Visit visit) {
  const Eigen::AlignedBox3d box = bounds(shape, X_WS);
  const Eigen::Isometry3d X_SW = X_WS.inverse();
  Eigen::Vector3i lo, hi;
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::max(least[a], static_cast<int>(std::floor((box.min()[a] - margin - origin[a]) / cell)));
    hi[a] = std::min(most[a], static_cast<int>(std::floor((box.max()[a] + margin - origin[a]) / cell)));
  }
  for (int k = lo.z(); k <= hi.z(); ++k)
    for (int j = lo.y(); j <= hi.y(); ++j)
      for (int i = lo.x(); i <= hi.x(); ++i) {
        if (!interest(Eigen::Vector3i(i, j, k))) continue;
        const Eigen::Vector3d p_W = origin + cell * (Eigen::Vector3d(i, j, k).array() + 0.5).matrix();
        if (signed_distance(shape, X_SW * p_W) <= margin) visit(Eigen::Vector3i(i, j, k), p_W);
      }
}

}  // namespace

VoxelVolume::VoxelVolume(const Eigen::AlignedBox3d& bounds, double cell) : cell_(cell) {
  for (int a = 0; a < 3; ++a) {
    const double lo = std::floor(bounds.min()[a] / cell), hi = std::ceil(bounds.max()[a] / cell);
    origin_[a] = lo * cell;
    size_[a] = std::max(0, static_cast<int>(hi - lo));
  }
  cells_.assign(
      static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(size_.z()),
      0);
}

Eigen::Vector3i VoxelVolume::index_of(const Eigen::Vector3d& p_W) const {
  return ((p_W - origin_) / cell_).array().floor().cast<int>();
}

Eigen::Vector3d VoxelVolume::centre_of(const Eigen::Vector3i& index) const {
  return origin_ + cell_ * (index.cast<double>().array() + 0.5).matrix();
}

void VoxelVolume::add(const Shape& shape, const Eigen::Isometry3d& X_WS) {
  // Most cells of a sweep are marked many times over: those cost no distance.
  for_cells(
      shape, X_WS, origin_, cell_, 0.5 * cell_, Eigen::Vector3i::Zero(), size_.array() - 1,
      [&](const Eigen::Vector3i& index) { return cells_[offset(index)] == 0; },
      [&](const Eigen::Vector3i& index, const Eigen::Vector3d&) {
        cells_[offset(index)] = 1;
        ++count_;
      });
}

VoxelVolume::Overlap VoxelVolume::overlap(const Object& object, const Eigen::Isometry3d& X_WO) const {
  Overlap out;
  const Eigen::Vector3i any = Eigen::Vector3i::Constant(1 << 28);
  for (std::size_t s = 0; s < object.shapes.size(); ++s)
    for_cells(
        object.shapes[s].shape, X_WO * object.shapes[s].X_BS, origin_, cell_, 0.0, -any, any,
        [](const Eigen::Vector3i&) { return true; },
        [&](const Eigen::Vector3i& index, const Eigen::Vector3d& p_W) {
          for (std::size_t t = 0; t < s; ++t)  // a cell of two shapes counts once
            if (signed_distance(object.shapes[t].shape, (X_WO * object.shapes[t].X_BS).inverse() * p_W) <= 0) return;
          ++out.object_cells;
          out.common_cells += contains(index);
        });
  return out;
}

}  // namespace mamo
