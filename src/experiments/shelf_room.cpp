#include "experiments/shelf_room.hpp"

#include "mamo/io/profile.hpp"

namespace mamo {

std::vector<Object> shelf_fixtures(const Compartment& inside, Profile profile) {
  constexpr double kBoard = 0.04, kWallHeight = 0.4;  // m
  const double depth = inside.x[1] - inside.x[0], width = inside.y[1] - inside.y[0];
  const double x = (inside.x[0] + inside.x[1]) / 2, y = (inside.y[0] + inside.y[1]) / 2;
  const double wall_z = inside.floor + inside.clear_height / 2;
  struct Part {
    const char* id;
    Eigen::Vector3d centre, size;
  };
  const Part parts[] = {
      {"shelf_base", {x, y, inside.floor - kBoard / 2}, {depth, width, kBoard}},
      {"shelf_back", {inside.x[1] + kBoard / 2, y, wall_z}, {kBoard, width, kWallHeight}},
      {"shelf_top", {x, y, inside.floor + inside.clear_height + kBoard / 2}, {depth, width, kBoard}},
      {"shelf_right", {x + kBoard / 2, inside.y[0] - kBoard / 2, wall_z}, {depth + kBoard, kBoard, kWallHeight}},
      {"shelf_left", {x + kBoard / 2, inside.y[1] + kBoard / 2, wall_z}, {depth + kBoard, kBoard, kWallHeight}}};
  std::vector<Object> fixtures;
  for (const Part& part : parts) {
    Object o;
    o.id = part.id;
    o.kind = ObjectKind::fixture;
    o.shapes = {{Box{part.size}, Eigen::Isometry3d::Identity()}};
    o.X_WO.translation() = part.centre;
    o.friction = 0.8;
    o.constraints = io::default_constraints(profile, ObjectKind::fixture);
    if (!fixtures.empty()) o.constraints.touch = profile == Profile::legacy ? Touch::objects : Touch::forbidden;
    fixtures.push_back(std::move(o));
  }
  return fixtures;
}

}  // namespace mamo
