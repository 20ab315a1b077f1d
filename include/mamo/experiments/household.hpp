// Household things to put on tables: sizes and masses of common objects of the YCB set (Calli et al. 2015).
#pragma once

#include <span>
#include <string_view>

#include "mamo/model/shape.hpp"

namespace mamo {

/// One thing as it stands upright: its shape is centred, z up.
struct HouseholdItem {
  std::string_view name;  // of the YCB set, without its number
  Shape shape;
  double mass;      // kg
  double friction;  // coefficient
};

/// In a fixed order: generated files depend on it.
std::span<const HouseholdItem> household_items();

/// Radius of the smallest upright cylinder around its axis that holds the shape (m); its height (m).
double footprint_radius(const Shape& shape);
double height(const Shape& shape);

}  // namespace mamo
