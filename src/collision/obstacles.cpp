#include "obstacles.hpp"

namespace mamo::collision {
namespace {

Eigen::Isometry3d moved_by(const Eigen::Isometry3d& X, const Eigen::Vector3d& p) {
  Eigen::Isometry3d out = X;
  out.translate(p);
  return out;
}

Placed placed(const Eigen::Isometry3d& X) { return {X.linear(), X.translation()}; }

}  // namespace

Obstacles::Obstacles(const Scene& scene, double padding) : state_(WorldState::start_of(scene)) {
  for (std::size_t i = 0; i < scene.size(); ++i) {
    first_.push_back(parts_.size());
    for (const PlacedShape& s : scene.objects[i].shapes) {
      parts_.emplace_back();
      ObstaclePart& part = parts_.back();
      part.object = ObjectId(i);
      Eigen::Vector3d centre;
      part.plain = make_solid(s.shape, 0, centre);
      part.X_OS = moved_by(s.X_BS, centre);
      part.padded = make_solid(s.shape, padding, centre);
      part.X_OP = moved_by(s.X_BS, centre);
    }
  }
  first_.push_back(parts_.size());
  for (std::size_t i = 0; i < scene.size(); ++i) place(i);
}

void Obstacles::set_state(const WorldState& state) {
  for (std::size_t i = 0; i < state.poses.size(); ++i) {
    if (state_.poses[i] == state.poses[i]) continue;
    state_.poses[i] = state.poses[i];
    place(i);
  }
}

void Obstacles::place(std::size_t object) {
  const Eigen::Isometry3d X_WO = dequantise(state_.poses[object]);
  for (std::size_t k = first_[object]; k < first_[object + 1]; ++k) {
    ObstaclePart& part = parts_[k];
    part.X_WS = placed(X_WO * part.X_OS);
    part.X_WP = placed(X_WO * part.X_OP);
    part.half_box_plain = half_box(part.plain, part.X_WS.R);
    part.half_box_padded = half_box(part.padded, part.X_WP.R);
  }
}

// Depth is not asked of FCL (its penetration code throws on some touching contacts): two bodies that overlap by more
// than the tolerance still overlap when each has lost half of it all around.
std::vector<std::pair<ObjectId, ObjectId>> overlaps(const Scene& scene, const Obstacles& obstacles, double tolerance) {
  struct Shrunk {
    Solid solid;
    Placed X_WS;
  };
  std::vector<Shrunk> shrunk;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    for (std::size_t k = 0; k < scene.objects[i].shapes.size(); ++k) {
      const PlacedShape& s = scene.objects[i].shapes[k];
      const ObstaclePart& part = obstacles.parts()[obstacles.first_part(i) + k];
      Eigen::Vector3d centre, plain_centre;
      make_solid(s.shape, 0, plain_centre);
      Shrunk small;
      small.solid = make_solid(s.shape, -tolerance / 2, centre);
      small.X_WS = {part.X_WS.R, part.X_WS.p + part.X_WS.R * (centre - plain_centre)};
      shrunk.push_back(std::move(small));
    }
  }
  std::vector<std::pair<ObjectId, ObjectId>> pairs;
  for (std::size_t i = 0; i < shrunk.size(); ++i) {
    for (std::size_t k = i + 1; k < shrunk.size(); ++k) {
      const ObjectId a = obstacles.parts()[i].object, b = obstacles.parts()[k].object;
      if (a == b || (scene[a].fixture() && scene[b].fixture())) continue;
      if (relate(shrunk[i].solid, shrunk[i].X_WS, shrunk[k].solid, shrunk[k].X_WS, 0) == Relation::hit)
        pairs.emplace_back(a, b);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace mamo::collision
