#include "edge_check.hpp"

#include <stdexcept>

namespace mamo::collision {
namespace {

// A stretch is at most so long (m, by the crudest bound): within it levers, and so speeds, hardly change.
constexpr double kStretch = 0.25;

bool boxes_meet(const Eigen::Vector3d& centre_a, const Eigen::Vector3d& half_a, const Eigen::Vector3d& centre_b,
                const Eigen::Vector3d& half_b) {
  return std::abs(centre_a.x() - centre_b.x()) <= half_a.x() + half_b.x() &&
         std::abs(centre_a.y() - centre_b.y()) <= half_a.y() + half_b.y() &&
         std::abs(centre_a.z() - centre_b.z()) <= half_a.z() + half_b.z();
}

void demand_finite(const Eigen::VectorXd& q) {
  if (!q.allFinite()) throw std::invalid_argument("collision check of a configuration that is not finite");
}

/// 0 .. count-1, the middle first, then the middles of the halves, and so on.
void coarse_to_fine(int count, std::vector<int>& order) {
  order.clear();
  std::vector<std::pair<int, int>> ranges{{0, count}};
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const auto [low, high] = ranges[k];
    if (low >= high) continue;
    const int middle = (low + high) / 2;
    order.push_back(middle);
    ranges.emplace_back(low, middle);
    ranges.emplace_back(middle + 1, high);
  }
}

}  // namespace

void EdgeCheck::pose(const Eigen::VectorXd& q) {
  ++poses_;
  kinematics_.link_poses(q, X_WL_);
  placed_.resize(arm_.parts().size());
}

void EdgeCheck::pose_at(double s, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  q_ = (1.0 - s) * q0 + s * q1;
  pose(q_);
}

const Placed& EdgeCheck::placed(int part) {
  PlacedPart& p = placed_[static_cast<std::size_t>(part)];
  if (p.stamp != poses_) {
    p.X = arm_.placed(part, X_WL_);
    p.stamp = poses_;
  }
  return p.X;
}

void EdgeCheck::configuration(const Eigen::VectorXd& q, const ObjectSet& against, ObjectId held, bool stop_at_first,
                              CollisionReport& out) {
  demand_finite(q);
  out = {};
  pose(q);
  for (const SelfPair& pair : arm_.self_pairs()) {
    const Solid& a = arm_.parts()[static_cast<std::size_t>(pair.a)].solid;
    const Solid& b = arm_.parts()[static_cast<std::size_t>(pair.b)].solid;
    if (relate(a, placed(pair.a), b, placed(pair.b), 0) != Relation::hit) continue;
    out.self = true;
    out.first_self = {pair.la, pair.lb};
    if (stop_at_first) return;
    break;
  }
  boxes_.resize(arm_.parts().size());
  for (int part : arm_.moving())
    boxes_[static_cast<std::size_t>(part)] =
        half_box(arm_.parts()[static_cast<std::size_t>(part)].solid, placed(part).R);
  for (const ObstaclePart& obstacle : obstacles_.parts()) {
    if (obstacle.object == held || !against.contains(obstacle.object)) continue;
    if (!out.touched.empty() && out.touched.back() == obstacle.object) continue;
    for (int part : arm_.moving()) {
      const Placed& X = placed(part);
      if (!boxes_meet(X.p, boxes_[static_cast<std::size_t>(part)], obstacle.X_WS.p, obstacle.half_box_plain)) continue;
      const Solid& solid = arm_.parts()[static_cast<std::size_t>(part)].solid;
      if (relate(solid, X, obstacle.plain, obstacle.X_WS, 0) != Relation::hit) continue;
      out.touched.push_back(obstacle.object);
      if (stop_at_first) return;
      break;
    }
  }
}

void EdgeCheck::begin_edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  dq_ = q1 - q0;
  demand_finite(dq_);
  const int count = std::max(1, static_cast<int>(std::ceil(arm_.travel().worst_speed(dq_) / kStretch)));
  stretches_.resize(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    stretches_[static_cast<std::size_t>(k)] = {static_cast<double>(k) / count, static_cast<double>(k + 1) / count, 1,
                                               k + 1 == count};
  speeds_.resize(stretches_.size() * arm_.parts().size());
  pair_speeds_.resize(stretches_.size() * arm_.self_pairs().size());
}

/// The arm is posed at the middle of the stretch. Decides how many samples the stretch needs.
void EdgeCheck::measure(int index) {
  Stretch& stretch = stretches_[static_cast<std::size_t>(index)];
  ArmTravel& travel = arm_.travel();
  const double length = stretch.end - stretch.begin;
  travel.update(X_WL_, dq_, length / 2);
  stretch.intervals = std::max(1, static_cast<int>(std::ceil(travel.largest_speed() * length / options_.edge_step)));
  double* speeds = speeds_.data() + static_cast<std::size_t>(index) * arm_.parts().size();
  for (std::size_t k = 0; k < arm_.parts().size(); ++k) speeds[k] = travel.speed(static_cast<int>(k));
  double* pairs = pair_speeds_.data() + static_cast<std::size_t>(index) * arm_.self_pairs().size();
  for (std::size_t k = 0; k < arm_.self_pairs().size(); ++k) pairs[k] = travel.pair_speed(static_cast<int>(k));
}

std::vector<double> EdgeCheck::samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  std::vector<double> out;
  begin_edge(q0, q1);
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    pose_at((stretches_[k].begin + stretches_[k].end) / 2, q0, q1);
    measure(static_cast<int>(k));
    for (int i = 0; i < stretches_[k].samples(); ++i) out.push_back(stretches_[k].at(i));
  }
  return out;
}

bool EdgeCheck::edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const ObjectSet& forbidden,
                     const ObjectSet& watched, ObjectId held, CollisionReport& out) {
  out = {};
  const std::vector<ObstaclePart>& obstacles = obstacles_.parts();
  role_.assign(obstacles.size(), ignored);
  active_.clear();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const ObjectId object = obstacles[k].object;
    if (object == held) continue;
    role_[k] = forbidden.contains(object) ? forbidden_role : watched.contains(object) ? watched_role : ignored;
    if (role_[k] != ignored) active_.push_back(static_cast<std::int32_t>(k));
  }
  touched_.assign(obstacles.empty() ? 0 : obstacles.back().object.index() + 1, 0);
  nodes_.clear();
  pairs_.clear();
  self_pairs_.clear();

  begin_edge(q0, q1);
  coarse_to_fine(static_cast<int>(stretches_.size()), order_);
  for (int k : order_) nodes_.push_back({k, 0, 0, {0, 0}, {0, 0}, true});
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (!visit(nodes_[k], q0, q1, out)) return false;
  for (std::size_t k = 0; k < touched_.size(); ++k)
    if (touched_[k]) out.touched.emplace_back(k);
  return true;
}

/// Tests the middle sample of a node and queues the two halves with the pairs that are still open.
bool EdgeCheck::visit(Node node, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, CollisionReport& out) {
  const Stretch& stretch = stretches_[static_cast<std::size_t>(node.stretch)];
  bool posed = false;
  if (node.root) {
    pose_at((stretch.begin + stretch.end) / 2, q0, q1);
    measure(node.stretch);
    node.high = stretch.samples() - 1;
    posed = stretch.intervals % 2 == 0;
  }
  const int middle = node.root && posed ? stretch.intervals / 2 : (node.low + node.high) / 2;
  const double s = stretch.at(middle), s_low = stretch.at(node.low);
  const double reach = std::max(s - s_low, stretch.at(node.high) - s);
  if (!posed) pose_at(s, q0, q1);
  if (node.root) gather(node, reach);
  if (!test_obstacles(node, s, s_low, reach, out) || !test_self(node, reach, out)) return false;
  if (node.pairs.begin == node.pairs.end && node.self.begin == node.self.end) return true;
  if (node.low < middle) nodes_.push_back({node.stretch, node.low, middle - 1, node.pairs, node.self, false});
  if (middle < node.high) nodes_.push_back({node.stretch, middle + 1, node.high, node.pairs, node.self, false});
  return true;
}

/// All pairs whose boxes, grown by what the part can move, meet.
void EdgeCheck::gather(Node& root, double reach) {
  root.pairs = {pairs_.size(), pairs_.size()};
  for (int part : arm_.moving()) {
    const Placed& X = placed(part);
    const Eigen::Vector3d half =
        half_box(arm_.parts()[static_cast<std::size_t>(part)].solid, X.R).array() + speed(root.stretch, part) * reach;
    for (std::int32_t k : active_) {
      const ObstaclePart& obstacle = obstacles_.parts()[static_cast<std::size_t>(k)];
      if (boxes_meet(X.p, half, obstacle.X_WP.p, obstacle.half_box_padded)) pairs_.push_back({part, k});
    }
  }
  root.pairs.end = pairs_.size();
  root.self.begin = self_pairs_.size();
  for (std::size_t k = 0; k < arm_.self_pairs().size(); ++k) self_pairs_.push_back(static_cast<std::int32_t>(k));
  root.self.end = self_pairs_.size();
}

/// Leaves in node.pairs those that the halves have to look at. False: a forbidden object is hit.
bool EdgeCheck::test_obstacles(Node& node, double s, double s_low, double reach, CollisionReport& out) {
  const std::size_t begin = pairs_.size();
  for (std::size_t k = node.pairs.begin; k < node.pairs.end; ++k) {
    const Pair pair = pairs_[k];
    const ObstaclePart& obstacle = obstacles_.parts()[static_cast<std::size_t>(pair.obstacle)];
    // A touched object is of interest only where the edge might have touched something earlier.
    if (touched_[obstacle.object.index()] && s_low >= out.first_touch) continue;
    const bool forbidden = role_[static_cast<std::size_t>(pair.obstacle)] == forbidden_role;
    const Relation relation =
        relate(arm_.parts()[static_cast<std::size_t>(pair.part)].solid, placed(pair.part),
               forbidden ? obstacle.plain : obstacle.padded, forbidden ? obstacle.X_WS : obstacle.X_WP,
               speed(node.stretch, pair.part) * reach);
    if (relation == Relation::apart) continue;
    pairs_.push_back(pair);
    if (relation != Relation::hit) continue;
    if (forbidden) {
      out.touched = {obstacle.object};
      out.first_touch = CollisionReport{}.first_touch;
      return false;
    }
    touched_[obstacle.object.index()] = 1;
    out.first_touch = std::min(out.first_touch, s);
  }
  node.pairs = {begin, pairs_.size()};
  return true;
}

bool EdgeCheck::test_self(Node& node, double reach, CollisionReport& out) {
  const std::size_t begin = self_pairs_.size();
  for (std::size_t k = node.self.begin; k < node.self.end; ++k) {
    const std::int32_t index = self_pairs_[k];
    const SelfPair& pair = arm_.self_pairs()[static_cast<std::size_t>(index)];
    const Relation relation = relate(arm_.parts()[static_cast<std::size_t>(pair.a)].solid, placed(pair.a),
                                     arm_.parts()[static_cast<std::size_t>(pair.b)].solid, placed(pair.b),
                                     pair_speed(node.stretch, index) * reach);
    if (relation == Relation::apart) continue;
    if (relation == Relation::hit) {
      out = {};
      out.self = true;
      out.first_self = {pair.la, pair.lb};
      return false;
    }
    self_pairs_.push_back(index);
  }
  node.self = {begin, self_pairs_.size()};
  return true;
}

}  // namespace mamo::collision
