#include "push/push_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mamo::push {
namespace {

constexpr double kClear = 0.01;         // m, of the tip from every object at the start
constexpr double kLeastStandoff = 0.005;  // m
constexpr double kHeightSpread = 0.04;  // m, the tip is at the height asked for or up to this higher

Eigen::Vector3d at_height(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

}  // namespace

PushSampler::PushSampler(const Problem& problem, const ForwardKinematics& kinematics, const PushOptions& options)
    : scene_(problem.scene), options_(options), gripper_(kinematics) {
  std::vector<Eigen::Isometry3d> X_WL;
  kinematics.link_poses(problem.q_start, X_WL);
  p_shoulder_ = X_WL[problem.robot.joint(0).child.index()].translation().head<2>();
}

double PushSampler::extent(const PushRequest& request, const Eigen::Vector3d& d) const {
  const Eigen::Isometry3d X_WO = request.state.X_WO(request.object);
  double farthest = -std::numeric_limits<double>::infinity();
  for (const PlacedShape& placed : scene_[request.object].shapes) {
    const Eigen::Isometry3d X_WS = X_WO * placed.X_BS;
    const Eigen::Vector3d p = X_WS * support(placed.shape, X_WS.linear().transpose() * d);
    farthest = std::max(farthest, (p - X_WO.translation()).dot(d));
  }
  return farthest;
}

double PushSampler::bottom(const PushRequest& request) const {
  return request.state.X_WO(request.object).translation().z() - extent(request, -Eigen::Vector3d::UnitZ());
}

TipWay PushSampler::sample(const PushRequest& request, RandomStream& random) const {
  std::vector<Eigen::Vector2d> path = {request.path.front()};
  for (const Eigen::Vector2d& p : request.path)
    if ((p - path.back()).norm() > 1e-6) path.push_back(p);
  if (options_.straight && path.size() > 2) path = {path.front(), path.back()};
  const Eigen::Vector2d d = path.size() > 1 ? (path[1] - path[0]).normalized() : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d across(-d.y(), d.x());
  const Eigen::Vector3d d_W = at_height(d, 0), across_W = at_height(across, 0);
  const double half_width = std::min(extent(request, across_W), extent(request, -across_W));

  // The gripper's heading lies between the push's own (paper) and where the arm points anyway.
  const double push_yaw = std::atan2(d.y(), d.x());
  const Eigen::Vector2d from_shoulder = path[0] - p_shoulder_;
  const double arm_yaw = std::atan2(from_shoulder.y(), from_shoulder.x());
  const double turn = std::remainder(push_yaw - arm_yaw, 2 * std::numbers::pi);
  const double yaw = arm_yaw + random.uniform() * turn;
  const double pitch = options_.pitch_deg * std::numbers::pi / 180 * random.uniform();
  const double height = options_.height + kHeightSpread * random.uniform();

  TipWay way;
  way.X_WT.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const double contact = extent(request, -d_W) + gripper_.reach(way.X_WT.linear(), d_W, half_width);
  const double standoff = std::max(kLeastStandoff, options_.standoff + options_.noise * random.normal());
  // Off the centre the object turns rather than moves: never further than half of its half width.
  const auto lateral = [&] {
    return std::clamp(options_.noise * random.normal(), -0.5 * half_width, 0.5 * half_width);
  };
  const double z = bottom(request) + height, start_lateral = lateral();
  way.points.push_back(at_height(path[0] - (contact + standoff) * d + start_lateral * across, z));
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Eigen::Vector2d u = (path[k] - path[k - 1]).normalized();
    const double further = k + 1 == path.size() ? options_.overshoot : 0;
    way.points.push_back(at_height(path[k] + (further - contact) * u + lateral() * Eigen::Vector2d(-u.y(), u.x()), z));
  }
  way.X_WT.translation() = way.points.front();
  return way;
}

bool PushSampler::start_inside(const TipWay& way, const WorldState& state, const ObjectSet& against) const {
  for (const ObjectId id : against.ids())
    for (const PlacedShape& placed : scene_[id].shapes)
      if (signed_distance(placed.shape, (state.X_WO(id) * placed.X_BS).inverse() * way.points.front()) < kClear)
        return true;
  return false;
}

}  // namespace mamo::push
