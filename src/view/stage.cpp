#include "view/stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/plan_path.hpp"

namespace mamo::view {
namespace {

constexpr double kMoved = 0.005;  // m: an object that went further is shown as moved
constexpr double kTurned = 0.05;  // rad: or turned further

ObjectId target_of(const Task& task) {
  if (const ReachPose* reach = std::get_if<ReachPose>(&task)) return reach->target;
  if (const Retrieve* retrieve = std::get_if<Retrieve>(&task)) return retrieve->object;
  return kNoObject;
}

Eigen::AlignedBox3d bounds_of(const Object& object, const Eigen::Isometry3d& X_WO) {
  Eigen::AlignedBox3d box;
  for (const PlacedShape& s : object.shapes) box.extend(bounds(s.shape, X_WO * s.X_BS));
  return box;
}

/// Highest centre of what stands around: a fixture that begins above hides the scene.
double object_height(const Scene& scene) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Object& object : scene.objects)
    if (!object.fixture()) highest = std::max(highest, object.X_WO.translation().z());
  return highest;
}

/// Index of the last sample at or before a time, and how far it is to the next.
std::pair<std::size_t, double> sample_at(const std::vector<double>& t, double time_s) {
  if (time_s <= t.front()) return {0, 0.0};
  if (time_s >= t.back()) return {t.size() - 1, 0.0};
  const auto after = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time_s) - t.begin());
  return {after - 1, (time_s - t[after - 1]) / (t[after] - t[after - 1])};
}

}  // namespace

Stage::Stage(const Playback& playback)
    : playback_(playback), kinematics_(playback.problem->robot), target_(target_of(playback.problem->task)) {
  if (playback_.recording && playback_.recording->empty()) playback_.recording = nullptr;
  const Scene& scene = problem().scene;
  const double height = object_height(scene);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    StageObject shown;
    shown.id = ObjectId(i);
    const Object& object = scene.objects[i];
    if (playback_.result) {
      const auto& order = playback_.result->stats.relevant_objects;
      const auto found = std::find(order.begin(), order.end(), shown.id);
      if (found != order.end()) shown.relevant = static_cast<int>(found - order.begin()) + 1;
    }
    if (playback_.recording)
      for (const Recording::Contact& c : playback_.recording->contacts)
        shown.touched = shown.touched || c.a == shown.id || c.b == shown.id;
    shown.role = object.fixture()      ? "fixture"
                 : shown.id == target_ ? "target"
                 : !object.movable()   ? "immovable"
                 : moved(shown.id)     ? "moved"
                 : shown.relevant > 0  ? "relevant"
                                       : "movable";
    shown.see_through = object.fixture() && (object.constraints.touch != Touch::support ||
                                             bounds_of(object, object.X_WO).min().z() > height);
    objects_.push_back(shown);
  }
  double begin_s = 0;
  if (playback_.result)
    for (const Segment& segment : playback_.result->plan.segments) {
      segments_.push_back({segment.kind, segment.object, begin_s, begin_s + segment.motion.duration()});
      begin_s = segments_.back().end_s;
    }
}

bool Stage::moved(ObjectId id) const {
  Eigen::Isometry3d X = problem().scene[id].X_WO;
  if (playback_.recording) {
    X = X_WO_at(id, duration_s());
  } else if (playback_.result) {
    const auto poses = final_poses(problem(), playback_.result->plan);
    if (const auto found = poses.find(id); found != poses.end()) X = found->second;
  }
  const Eigen::Isometry3d& from = problem().scene[id].X_WO;
  return (X.translation() - from.translation()).norm() > kMoved ||
         Eigen::AngleAxisd(from.linear().transpose() * X.linear()).angle() > kTurned;
}

std::optional<Eigen::Isometry3d> Stage::goal() const {
  if (const auto* reach = std::get_if<ReachPose>(&problem().task)) return reach->X_WT;
  if (const auto* retrieve = std::get_if<Retrieve>(&problem().task)) return retrieve->X_WT_pregrasp;
  if (const auto* joints = std::get_if<ReachJoints>(&problem().task)) return kinematics_.tip_pose(joints->q);
  return std::nullopt;
}

Eigen::VectorXd Stage::q_at(double time_s) const {
  if (!playback_.recording) return problem().q_start;
  const auto [k, share] = sample_at(playback_.recording->t, time_s);
  const std::vector<Eigen::VectorXd>& q = playback_.recording->q;
  return share > 0 ? Eigen::VectorXd(q[k] + share * (q[k + 1] - q[k])) : q[k];
}

Eigen::Isometry3d Stage::X_WO_at(ObjectId id, double time_s) const {
  const Eigen::Isometry3d& start = problem().scene[id].X_WO;
  if (!playback_.recording) return start;
  const auto track = playback_.recording->tracks.find(id);
  if (track == playback_.recording->tracks.end()) return start;
  const auto [k, share] = sample_at(playback_.recording->t, time_s);
  Eigen::Isometry3d X = track->second.X_WO[k];
  if (share > 0) {
    const Eigen::Isometry3d& next = track->second.X_WO[k + 1];
    X.translation() += share * (next.translation() - X.translation());
    X.linear() = Eigen::Quaterniond(X.linear()).slerp(share, Eigen::Quaterniond(next.linear())).toRotationMatrix();
  }
  return X;
}

std::optional<Eigen::Vector3d> Stage::place_of(const Violation& v) const {
  const auto is = [&](const Recording::Contact& c) {
    const auto pair = [&](ObjectId x, ObjectId y) { return (c.a == x && c.b == y) || (c.a == y && c.b == x); };
    return pair(v.object, v.other) && c.begin_s <= v.time_s + 1e-6 && c.end_s >= v.time_s - 0.05;
  };
  if (playback_.recording)
    for (const Recording::Contact& c : playback_.recording->contacts)
      if (is(c)) return c.p_W;
  for (ObjectId id : {v.object, v.other}) {
    if (!id.valid() || id.index() >= problem().scene.size()) continue;
    const Object& object = problem().scene[id];
    if (object.fixture()) continue;
    return X_WO_at(id, v.time_s) * object.centre_of_mass();
  }
  if (playback_.recording) return kinematics_.tip_pose(q_at(v.time_s)).translation();
  return std::nullopt;
}

Eigen::AlignedBox3d Stage::scene_bounds() const {
  Eigen::AlignedBox3d box;
  for (const StageObject& shown : objects_) {
    const Object& object = problem().scene[shown.id];
    if (!object.fixture()) box.extend(bounds_of(object, object.X_WO));
  }
  box.extend(kinematics_.tip_pose(problem().q_start).translation());
  if (const auto X = goal()) box.extend(X->translation());
  if (playback_.recording)
    for (std::size_t k = 0; k < playback_.recording->q.size(); k += 10)
      box.extend(kinematics_.tip_pose(playback_.recording->q[k]).translation());
  return box;
}

Camera Stage::camera() const {
  const Eigen::AlignedBox3d box = scene_bounds();
  Camera camera;
  camera.target = box.center() - Eigen::Vector3d(0, 0, 0.08);
  const double radius = std::max(0.3, box.sizes().norm() / 2);
  camera.distance = 1.15 * radius / std::sin(Camera::kFieldOfView / 2);
  // Over the robot's shoulder, on the side where the arm is not in the way of what it reaches for.
  const Eigen::Vector2d to_robot = (problem().robot.X_WB.translation() - camera.target).head<2>();
  const Eigen::Vector2d tip = (kinematics_.tip_pose(problem().q_start).translation() - camera.target).head<2>();
  const double side = to_robot.x() * tip.y() - to_robot.y() * tip.x();
  camera.yaw = std::atan2(to_robot.y(), to_robot.x()) + (side > 0 ? -1 : 1) * 1.25;
  camera.pitch = 0.62;
  return camera;
}

}  // namespace mamo::view
