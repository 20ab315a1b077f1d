#include "verify/arm_check.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::verify {
namespace {

constexpr double kClear = 0.002;  // m: a held object this far from its support has left it

/// Upper bound on how far any point of the shapes on a link moves per unit of each group joint.
Eigen::VectorXd travel_of(const ForwardKinematics& kinematics, LinkId link, const std::vector<PlacedShape>& shapes,
                          const Eigen::Isometry3d& X_LS) {
  double reach = 0;
  for (const PlacedShape& s : shapes) {
    const Eigen::AlignedBox3d box = bounds(s.shape, X_LS * s.X_BS);
    reach = std::max(reach, box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm());
  }
  return kinematics.motion_bounds(link, Eigen::Vector3d(reach, 0, 0));
}

}  // namespace

ArmCheck::ArmCheck(const Problem& problem, const ForwardKinematics& kinematics, double step)
    : kinematics_(kinematics), step_(step) {
  const Robot& robot = problem.robot;
  const RobotModel& model = *robot.model;
  const std::vector<bool> moving = robot.moving_links();
  for (std::size_t i = 0; i < model.links.size(); ++i)
    if (moving[i] && !model.links[i].collision.empty())
      links_.push_back({LinkId(i), solids_of(model.links[i].collision),
                        travel_of(kinematics, LinkId(i), model.links[i].collision, Eigen::Isometry3d::Identity())});
  self_.resize(model.links.size());
  for (const auto& [a, b] : robot.self_pairs)
    for (LinkId id : {a, b})
      if (self_[id.index()].empty()) self_[id.index()] = solids_of(model.links[id.index()].collision);
  for (std::size_t i = 0; i < problem.scene.size(); ++i) {
    const Object& object = problem.scene.objects[i];
    if (!object.fixture() && object.mass > 0) continue;  // dynamic: the replay sees the contact
    statics_.push_back({ObjectId(i), robot_may_touch(object.constraints.touch), solids_of(object.shapes)});
    place(statics_.back().solids, object.X_WO);
  }
}

int ArmCheck::samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const Eigen::VectorXd* travel) const {
  const Eigen::VectorXd turned = (q1 - q0).cwiseAbs();
  double farthest = 0;
  if (travel)
    farthest = turned.dot(*travel);
  else
    for (const MovingLink& link : links_) farthest = std::max(farthest, turned.dot(link.travel));
  return std::max(1, static_cast<int>(std::ceil(farthest / step_)));
}

std::optional<ArmHit> ArmCheck::at(const Eigen::VectorXd& q) {
  kinematics_.link_poses(q, X_WL_);
  for (MovingLink& link : links_) {
    place(link.solids, X_WL_[link.id.index()]);
    for (const StaticBody& body : statics_)
      if (!body.touchable && overlap(link.solids, body.solids)) return ArmHit{0, body.id, link.id, LinkId{}, false};
  }
  for (std::size_t i = 0; i < self_.size(); ++i) place(self_[i], X_WL_[i]);
  for (const auto& [a, b] : kinematics_.robot().self_pairs)
    if (overlap(self_[a.index()], self_[b.index()])) return ArmHit{0, kRobot, a, b, false};
  return std::nullopt;
}

std::optional<ArmHit> ArmCheck::along(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  const int n = samples(q0, q1, nullptr);
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    if (std::optional<ArmHit> hit = at(q0 + s * (q1 - q0))) {
      hit->fraction = s;
      return hit;
    }
  }
  return std::nullopt;
}

bool ArmCheck::reaches(const Eigen::VectorXd& q, const Object& object, const Eigen::Isometry3d& X_WO, double margin) {
  std::vector<Solid> grown = solids_of(object.shapes, margin);
  place(grown, X_WO);
  kinematics_.link_poses(q, X_WL_);
  for (MovingLink& link : links_) {
    place(link.solids, X_WL_[link.id.index()]);
    if (overlap(link.solids, grown)) return true;
  }
  return false;
}

void ArmCheck::hold(const Object& object, LinkId link, const Eigen::Isometry3d& X_LO, std::set<ObjectId> support) {
  held_ = Held{link,
               X_LO,
               solids_of(object.shapes),
               solids_of(object.shapes, kClear),
               solids_of(object.shapes, -kMaxPenetration),
               travel_of(kinematics_, link, object.shapes, X_LO),
               std::move(support)};
}

std::optional<ArmHit> ArmCheck::held_at(const Eigen::VectorXd& q) {
  kinematics_.link_poses(q, X_WL_);
  const Eigen::Isometry3d X_WO = X_WL_[held_->link.index()] * held_->X_LO;
  for (std::vector<Solid>* solids : {&held_->solids, &held_->grown, &held_->shrunk}) place(*solids, X_WO);
  for (const StaticBody& body : statics_) {
    if (body.touchable) continue;
    const bool resting = held_->support.contains(body.id);
    if (overlap(resting ? held_->shrunk : held_->solids, body.solids))
      return ArmHit{0, body.id, held_->link, LinkId{}, true};
    if (resting && !overlap(held_->grown, body.solids)) held_->support.erase(body.id);
  }
  return std::nullopt;
}

std::optional<ArmHit> ArmCheck::held_along(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  const int n = samples(q0, q1, &held_->travel);
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    if (std::optional<ArmHit> hit = held_at(q0 + s * (q1 - q0))) {
      hit->fraction = s;
      return hit;
    }
  }
  return std::nullopt;
}

}  // namespace mamo::verify
