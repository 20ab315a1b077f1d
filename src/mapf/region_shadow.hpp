// The negative goal region as footprints meet it: which positions of an object overlap it.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mapf/surroundings.hpp"

#include "mamo/collision/voxel_volume.hpp"

namespace mamo::mapf {

/// A view of a region for one call. A body overlaps it when it shares space with a marked voxel, as a cube.
class RegionShadow {
 public:
  /// The region must outlive the view.
  explicit RegionShadow(const VoxelVolume& region) : region_(region) {}

  bool overlaps(const Footprint& footprint, const Eigen::Vector2d& p) const;
  /// Per cell of the grid: does the footprint overlap the region when it is there?
  std::vector<std::uint8_t> overlapping_cells(const Footprint& footprint, const CellGrid& grid);

 private:
  /// Layers of voxels [first, second) that a prism reaches into.
  std::pair<int, int> layers(const Prism& prism) const;
  bool marked(int i, int j, std::pair<int, int> layers) const;
  /// Positions of a prism that overlap the column with corner (0, 0).
  PlanarShape around_column(const Prism& prism) const;
  /// Columns that have a marked voxel in the layers, row by row.
  const std::vector<std::uint8_t>& columns(std::pair<int, int> layers);

  const VoxelVolume& region_;
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> columns_;
};

}  // namespace mamo::mapf
