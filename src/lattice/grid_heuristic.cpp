#include "mamo/lattice/grid_heuristic.hpp"

namespace mamo {
namespace {

constexpr std::int16_t kUnseen = -1, kWall = -2;

/// Largest ball around the centre of a shape that lies inside it (m).
double inscribed_radius(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->size.minCoeff() / 2;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return std::min(cylinder->radius, cylinder->length / 2);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  return -signed_distance(shape, std::get<Mesh>(shape).hull->centroid);
}

/// Links that never move relative to the tip: no group joint (nor a mimic of one) lies between.
std::vector<bool> rigid_with_tip(const Robot& robot) {
  const RobotModel& model = *robot.model;
  const auto driven = [&](const Joint& j) {
    const JointId id = j.mimic ? j.mimic->joint : model.links[j.child.index()].parent_joint;
    return std::find(robot.group.joints.begin(), robot.group.joints.end(), id) != robot.group.joints.end();
  };
  LinkId root = robot.group.tip;
  while (model.links[root.index()].parent_joint.valid()) {
    const Joint& j = model.joints[model.links[root.index()].parent_joint.index()];
    if (driven(j)) break;
    root = j.parent;
  }
  std::vector<bool> rigid(model.links.size(), false);
  rigid[root.index()] = true;
  for (const Joint& j : model.joints)  // parents first
    if (rigid[j.parent.index()] && !driven(j)) rigid[j.child.index()] = true;
  return rigid;
}

/// No point fixed at p_T in the tip frame is ever further than this from the first group joint's frame (m).
double largest_reach(const Robot& robot, const Eigen::Vector3d& p_T) {
  const RobotModel& model = *robot.model;
  double reach = p_T.norm();
  for (LinkId link = robot.group.tip; model.links[link.index()].parent_joint.valid();) {
    const JointId id = model.links[link.index()].parent_joint;
    const Joint& j = model.joints[id.index()];
    if (j.type == JointType::prismatic) reach += std::max(std::abs(j.lower), std::abs(j.upper));
    if (id == robot.group.joints.front()) break;
    reach += j.X_PJ.translation().norm();
    link = j.parent;
  }
  return reach;
}

}  // namespace

TrackedPoint tracked_point(const ForwardKinematics& kinematics) {
  const Robot& robot = kinematics.robot();
  std::vector<Eigen::Isometry3d> X_WL;
  kinematics.link_poses(robot.group_part(robot.posture), X_WL);
  const Eigen::Isometry3d X_TW = X_WL[robot.group.tip.index()].inverse();
  const std::vector<bool> rigid = rigid_with_tip(robot);
  TrackedPoint best;
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    if (!rigid[i]) continue;
    for (const PlacedShape& s : robot.model->links[i].collision) {
      const double radius = inscribed_radius(s.shape);
      if (radius <= best.radius) continue;
      const auto* mesh = std::get_if<Mesh>(&s.shape);
      const Eigen::Vector3d centre = mesh ? mesh->hull->centroid : Eigen::Vector3d(0, 0, 0);
      best = {X_TW * (X_WL[i] * (s.X_BS * centre)), radius};
    }
  }
  return best;
}

GridHeuristic::GridHeuristic(const ForwardKinematics& kinematics, const TrackedPoint& point, const Scene& scene,
                             const ObjectSet& walls, const Eigen::Vector3d& goal, double goal_radius, double cell)
    : cell_(cell) {
  const Robot& robot = kinematics.robot();
  const Joint& first = robot.joint(0);
  const Eigen::Isometry3d X_WF = kinematics.link_pose(robot.group_part(robot.posture), first.parent) * first.X_PJ;
  double reach = largest_reach(robot, point.p_T);
  reach += 2 * cell;
  origin_ = X_WF.translation() - Eigen::Vector3d::Constant(reach);
  size_ = Eigen::Vector3i::Constant(static_cast<int>(std::ceil(2 * reach / cell)) + 1);
  distance_.assign(static_cast<std::size_t>(size_.prod()), kUnseen);
  if (point.radius > 0)
    for (ObjectId id : walls.ids()) mark_walls(scene[id], point.radius);
  flood(goal, goal_radius);
}

int GridHeuristic::index_of(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d local = (p - origin_) / cell_;
  const Eigen::Vector3i c = local.array().floor().cast<int>();
  if ((c.array() < 0).any() || (c.array() >= size_.array()).any()) return -1;
  return (c.z() * size_.y() + c.y()) * size_.x() + c.x();
}

void GridHeuristic::mark_walls(const Object& object, double radius) {
  const double half_diagonal = cell_ * std::sqrt(3.0) / 2;
  for (const PlacedShape& s : object.shapes) {
    // A wall: every point of the cell is closer than `radius` to the shape. A hull's distance is exact inside only.
    const double limit = (std::holds_alternative<Mesh>(s.shape) ? 0.0 : radius) - half_diagonal;
    const Eigen::Isometry3d X_WS = object.X_WO * s.X_BS, X_SW = X_WS.inverse();
    const Eigen::AlignedBox3d box = bounds(s.shape, X_WS);
    const double margin = std::max(limit, 0.0);
    const Eigen::Vector3d lo = ((box.min() - origin_).array() - margin) / cell_,
                          hi = ((box.max() - origin_).array() + margin) / cell_;
    const Eigen::Vector3i a = lo.array().floor().cast<int>().max(0),
                          b = hi.array().ceil().cast<int>().min(size_.array() - 1);
    for (int z = a.z(); z <= b.z(); ++z)
      for (int y = a.y(); y <= b.y(); ++y)
        for (int x = a.x(); x <= b.x(); ++x) {
          const Eigen::Vector3d centre = origin_ + cell_ * (Eigen::Vector3d(x, y, z).array() + 0.5).matrix();
          if (signed_distance(s.shape, X_SW * centre) < limit)
            distance_[static_cast<std::size_t>((z * size_.y() + y) * size_.x() + x)] = kWall;
        }
  }
}

void GridHeuristic::flood(const Eigen::Vector3d& goal, double goal_radius) {
  std::vector<std::int32_t> frontier, next;
  const double radius = goal_radius + cell_ * std::sqrt(3.0) / 2;
  const Eigen::Vector3i a =
      ((goal - origin_).array() - radius).cwiseQuotient(Eigen::Array3d::Constant(cell_)).floor().cast<int>().max(0);
  const Eigen::Vector3i b = ((goal - origin_).array() + radius)
                                .cwiseQuotient(Eigen::Array3d::Constant(cell_))
                                .ceil()
                                .cast<int>()
                                .min(size_.array() - 1);
  for (int z = a.z(); z <= b.z(); ++z)
    for (int y = a.y(); y <= b.y(); ++y)
      for (int x = a.x(); x <= b.x(); ++x) {
        const Eigen::Vector3d centre = origin_ + cell_ * (Eigen::Vector3d(x, y, z).array() + 0.5).matrix();
        const std::int32_t index = (z * size_.y() + y) * size_.x() + x;
        if ((centre - goal).norm() > radius || distance_[static_cast<std::size_t>(index)] == kWall) continue;
        distance_[static_cast<std::size_t>(index)] = 0;
        frontier.push_back(index);
      }
  const int sx = size_.x(), sy = size_.y(), sz = size_.z();
  for (std::int16_t d = 1; !frontier.empty(); ++d, frontier.swap(next)) {
    next.clear();
    for (std::int32_t index : frontier) {
      const int x = index % sx, y = index / sx % sy, z = index / sx / sy;
      for (int w = std::max(z - 1, 0); w <= std::min(z + 1, sz - 1); ++w)
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, sy - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, sx - 1); ++u) {
            const std::int32_t neighbour = (w * sy + v) * sx + u;
            std::int16_t& cell = distance_[static_cast<std::size_t>(neighbour)];
            if (cell != kUnseen) continue;
            cell = d;
            next.push_back(neighbour);
          }
    }
  }
}

int GridHeuristic::distance(const Eigen::Vector3d& p_W) const {
  const int index = index_of(p_W);
  return index < 0 ? -1 : std::max<int>(distance_[static_cast<std::size_t>(index)], -1);
}

}  // namespace mamo
