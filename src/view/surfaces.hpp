// A moment of a stage as coloured triangles in world, for pictures.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "view/stage.hpp"

namespace mamo::view {

enum class Finish { lit, plain, floor };  // plain: its colour as it is, without light

struct Surface {
  std::array<Eigen::Vector3d, 3> p;  // world, m, counter-clockwise from outside
  Eigen::Vector3f colour;            // linear
  float alpha = 1;
  Finish finish = Finish::lit;
  int body = 0;  // lines are drawn where bodies meet
};

/// "#rrggbb" as linear light.
Eigen::Vector3f linear_colour(std::string_view hex);

std::vector<Surface> surfaces_at(const Stage& stage, const ImageOptions& options);

}  // namespace mamo::view
