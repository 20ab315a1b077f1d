#include "push/push_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mamo::push {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kClear = 0.01;           // m, of the tip from every object at the start
constexpr double kLeastStandoff = 0.005;  // m
constexpr double kFar = 0.12;             // m, the most that a wide draw adds to the standoff
constexpr double kFarShare = 0.3;         // of the wide draws
constexpr double kSteepShare = 0.4;
constexpr double kRolledShare = 0.3;
constexpr double kHeadingNoise = 0.2;  // rad
constexpr double kLeastPitch = -10 * kDegree, kMostPitch = 90 * kDegree;
constexpr double kHeightBelow = 0.01, kHeightAbove = 0.005;       // m around the height asked for
constexpr double kLeastClearance = 0.004, kMostClearance = 0.01;  // m between gripper and support

Eigen::Vector3d at_height(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

std::vector<Eigen::Vector2d> without_repeats(const std::vector<Eigen::Vector2d>& path, bool straight) {
  std::vector<Eigen::Vector2d> out = {path.front()};
  for (const Eigen::Vector2d& p : path)
    if ((p - out.back()).norm() > 1e-6) out.push_back(p);
  if (straight && out.size() > 2) out = {out.front(), out.back()};
  return out;
}

}  // namespace

PushSampler::PushSampler(const Problem& problem, const ForwardKinematics& kinematics, const PushOptions& options)
    : scene_(problem.scene), options_(options), gripper_(kinematics) {
  p_shoulder_ = kinematics.link_pose(problem.q_start, problem.robot.joint(0).child).translation().head<2>();
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

/// The heading lies between the push's own (paper) and where the arm points anyway.
Eigen::Matrix3d PushSampler::orientation(const Eigen::Vector2d& p, double push_yaw, Spread spread,
                                         RandomStream& random) const {
  const Eigen::Vector2d from_shoulder = p - p_shoulder_;
  const double arm_yaw = std::atan2(from_shoulder.y(), from_shoulder.x());
  const double turn = std::remainder(push_yaw - arm_yaw, 2 * std::numbers::pi);
  const double yaw = arm_yaw + random.uniform() * turn + kHeadingNoise * random.normal();
  const bool wide = spread == Spread::wide;
  const bool steep = wide && random.uniform() < kSteepShare, rolled = wide && random.uniform() < kRolledShare;
  const double pitch = random.uniform(kLeastPitch, steep ? kMostPitch : options_.pitch_deg * kDegree);
  const double roll = rolled ? (random.uniform() < 0.5 ? 90 : -90) * kDegree : 0.0;
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TipWay PushSampler::sample(const PushRequest& request, Spread spread, RandomStream& random) const {
  const std::vector<Eigen::Vector2d> path = without_repeats(request.path, options_.straight);
  const Eigen::Vector2d d = (path[1] - path[0]).normalized(), across(-d.y(), d.x());
  const Eigen::Vector3d d_W = at_height(d, 0), across_W = at_height(across, 0);
  const double half_width = std::min(extent(request, across_W), extent(request, -across_W));
  const double behind = extent(request, -d_W);

  TipWay way;
  way.X_WT.linear() = orientation(path[0] - behind * d, std::atan2(d.y(), d.x()), spread, random);
  // From its origin to the tip, when the gripper touches the object.
  const double contact = behind + gripper_.reach(way.X_WT.linear(), d_W, half_width);
  const double floor =
      request.state.X_WO(request.object).translation().z() - extent(request, -Eigen::Vector3d::UnitZ());
  const double lowest =
      gripper_.reach(way.X_WT.linear(), -Eigen::Vector3d::UnitZ(), 1) + random.uniform(kLeastClearance, kMostClearance);
  const double z = floor + std::max(options_.height + random.uniform(-kHeightBelow, kHeightAbove), lowest);

  double standoff = std::max(kLeastStandoff, random.uniform(kLeastStandoff, options_.standoff + options_.noise));
  if (spread == Spread::wide && random.uniform() < kFarShare) standoff += random.uniform(0, kFar);
  // Off the centre the object turns rather than moves: never further than half of its half width.
  const auto lateral = [&] {
    return std::clamp(options_.noise * random.normal(), -0.5 * half_width, 0.5 * half_width);
  };
  way.free_length = standoff;
  way.points.push_back(at_height(path[0] - (contact + standoff) * d + lateral() * across, z));
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
  return gripper_.surely_hits(scene_, state, against, way.X_WT);
}

}  // namespace mamo::push
