// A convex shape that can be put somewhere and asked whether it overlaps another. FCL stays in solid.cpp.
#pragma once

#include <Eigen/Geometry>

#include <memory>
#include <vector>

#include "mamo/model/shape.hpp"

namespace mamo::verify {

/// Not thread-safe (FCL's objects are mutable): each verification makes its own.
class Solid {
 public:
  /// The shape grown by `inflation` metres on every side (shrunk where negative, never to nothing).
  explicit Solid(const PlacedShape& shape, double inflation = 0);
  ~Solid();
  Solid(Solid&&) noexcept;
  Solid& operator=(Solid&&) noexcept;

  /// Puts the body that carries the shape at X_WB.
  void place(const Eigen::Isometry3d& X_WB);
  bool overlaps(const Solid& other) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// All shapes of one body.
std::vector<Solid> solids_of(const std::vector<PlacedShape>& shapes, double inflation = 0);
void place(std::vector<Solid>& body, const Eigen::Isometry3d& X_WB);
bool overlap(const std::vector<Solid>& a, const std::vector<Solid>& b);

}  // namespace mamo::verify
