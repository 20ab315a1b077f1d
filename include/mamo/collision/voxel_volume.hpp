// A set of cubic cells of the workspace: the negative goal region of E-M4M, and how much of an object lies in it.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

#include "mamo/model/scene.hpp"

namespace mamo {

/// Cells of a grid over fixed bounds; what lies outside the bounds is not kept. Cell (i, j, k) covers
/// origin + cell * ([i, i+1) x [j, j+1) x [k, k+1)) in world.
class VoxelVolume {
 public:
  /// Empty and without a grid.
  VoxelVolume() = default;
  /// cell: edge length (m) > 0; bounds are rounded outwards to whole cells.
  VoxelVolume(const Eigen::AlignedBox3d& bounds, double cell);

  /// Marks every cell whose centre is within half a cell of the shape (so a swept surface leaves no gaps).
  void add(const Shape& shape, const Eigen::Isometry3d& X_WS);

  double cell() const { return cell_; }
  const Eigen::Vector3d& origin() const { return origin_; }
  const Eigen::Vector3i& size() const { return size_; }
  bool contains(const Eigen::Vector3i& index) const {
    return (index.array() >= 0).all() && (index.array() < size_.array()).all() && cells_[offset(index)] != 0;
  }
  bool contains(const Eigen::Vector3d& p_W) const { return contains(index_of(p_W)); }
  Eigen::Vector3i index_of(const Eigen::Vector3d& p_W) const;
  Eigen::Vector3d centre_of(const Eigen::Vector3i& index) const;
  std::int64_t count() const { return count_; }

  /// Cells of the grid's lattice (inside the bounds or not) whose centre lies in the object's shapes at X_WO, and how
  /// many of those are marked.
  struct Overlap {
    std::int64_t object_cells = 0;
    std::int64_t common_cells = 0;
  };
  Overlap overlap(const Object& object, const Eigen::Isometry3d& X_WO) const;

 private:
  std::size_t offset(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * static_cast<std::size_t>(size_.y()) + static_cast<std::size_t>(i.y())) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(i.x());
  }

  double cell_ = 0.01;
  Eigen::Vector3d origin_{0, 0, 0};
  Eigen::Vector3i size_{0, 0, 0};
  std::int64_t count_ = 0;
  std::vector<std::uint8_t> cells_;
};

}  // namespace mamo
