// What stays, as an object of one footprint sees it: where its centre may be, and how close that is to something.
#pragma once

#include <cstdint>
#include <vector>

#include "mapf/footprint.hpp"

#include "mamo/mapf/object_paths.hpp"

namespace mamo::mapf {

/// The cells of the supports, within a metre of where the objects are at the start. Immutable.
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, double cell);

  double cell() const { return cell_; }
  std::int32_t size() const { return width_ * height_; }
  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  /// The cell whose centre is next to p, in the grid or not.
  GridCell nearest(const Eigen::Vector2d& p) const;
  /// -1: not in the grid.
  std::int32_t node(const GridCell& c) const {
    const std::int32_t x = c.x - first_.x, y = c.y - first_.y;
    return x >= 0 && y >= 0 && x < width_ && y < height_ ? y * width_ + x : -1;
  }
  GridCell at(std::int32_t node) const { return {first_.x + node % width_, first_.y + node / width_}; }
  Eigen::Vector2d centre(const GridCell& c) const { return {c.x * cell_, c.y * cell_}; }

 private:
  double cell_ = 0.01;
  GridCell first_;
  std::int32_t width_ = 0, height_ = 0;
};

/// Something that stays, in the plane of the object's centre: where that may not be.
struct Obstacle {
  ObjectId object;
  std::vector<PlanarShape> shapes;
  Eigen::Vector2d lower, upper;  // bounds of the shapes (m)

  double distance(const Eigen::Vector2d& p) const { return signed_distance(shapes, p); }
  /// Is p within `margin` of the bounds? If not, it is further than that from the shapes.
  bool near(const Eigen::Vector2d& p, double margin) const {
    return ((p - lower).array() > -margin).all() && ((upper - p).array() > -margin).all();
  }
};

struct Surroundings {
  static constexpr std::uint8_t kBlocked = 255;
  static constexpr std::uint8_t kContact = 10;  // preference cost of a cell at which the object touches something

  std::vector<Obstacle> obstacles;
  const std::vector<PlanarShape>* supports = nullptr;  // the centre must be inside of one; null: anywhere
  std::vector<std::uint8_t> cost;  // per cell of the grid: kBlocked, or int(10^(1 - distance / clearance)), 0 beyond

  bool supported(const Eigen::Vector2d& p) const;
};

/// Fixtures, immovables and the target at the start, and what stands on what. Immutable.
class Stage {
 public:
  Stage(const Scene& scene, ObjectId target, const ObjectPathsOptions& options);

  const CellGrid& grid() const { return grid_; }
  /// The support that an object of this footprint stands on when its centre is at p: the highest one below it, one
  /// under its centre first. -1: none, it cannot be moved.
  int level_of(const Footprint& footprint, const Eigen::Vector2d& p) const;
  Surroundings surroundings(const Footprint& footprint, int level) const;

 private:
  /// Supports of one height: objects may be pushed from one to the other.
  struct Level {
    double top;  // m
    std::vector<PlanarShape> areas;
  };
  struct Still {
    ObjectId object;
    Footprint footprint;
    Eigen::Vector2d p;
  };

  CellGrid grid_;
  double clearance_;
  std::vector<Still> stills_;
  std::vector<Level> levels_;  // ascending
};

}  // namespace mamo::mapf
