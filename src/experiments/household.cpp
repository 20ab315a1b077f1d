#include "mamo/experiments/household.hpp"

namespace mamo {

// YCB numbers 1 to 10, 21, 25 and 36; bottles and the mug as the primitive around their body. Friction is that of
// cardboard, tin and plastic on wood, to one digit: the set gives none.
std::span<const HouseholdItem> household_items() {
  static const HouseholdItem kItems[] = {
      {"chips_can", Cylinder{0.0375, 0.25}, 0.205, 0.8},
      {"master_chef_can", Cylinder{0.051, 0.139}, 0.414, 0.7},
      {"cracker_box", Box{{0.06, 0.16, 0.21}}, 0.411, 0.8},
      {"sugar_box", Box{{0.045, 0.09, 0.175}}, 0.514, 0.8},
      {"tomato_soup_can", Cylinder{0.033, 0.101}, 0.349, 0.7},
      {"mustard_bottle", Box{{0.05, 0.085, 0.175}}, 0.603, 0.7},
      {"tuna_fish_can", Cylinder{0.0425, 0.033}, 0.171, 0.7},
      {"pudding_box", Box{{0.035, 0.11, 0.089}}, 0.187, 0.8},
      {"gelatin_box", Box{{0.028, 0.085, 0.073}}, 0.097, 0.8},
      {"potted_meat_can", Box{{0.05, 0.097, 0.082}}, 0.37, 0.7},
      {"bleach_cleanser", Box{{0.065, 0.098, 0.25}}, 1.131, 0.7},
      {"mug", Cylinder{0.04, 0.082}, 0.118, 0.7},
      {"wood_block", Box{{0.085, 0.085, 0.2}}, 0.729, 0.8},
  };
  return kItems;
}

double footprint_radius(const Shape& shape) {
  if (const Box* box = std::get_if<Box>(&shape)) return std::hypot(box->size.x(), box->size.y()) / 2;
  const Eigen::AlignedBox3d around = bounds(shape, Eigen::Isometry3d::Identity());
  return around.max().head<2>().cwiseAbs().maxCoeff();
}

double height(const Shape& shape) { return bounds(shape, Eigen::Isometry3d::Identity()).diagonal().z(); }

}  // namespace mamo
