#include "verify/constraints.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::verify {
namespace {

std::pair<ObjectId, ObjectId> ordered(ObjectId a, ObjectId b) { return a < b ? std::pair(a, b) : std::pair(b, a); }

}  // namespace

Constraints::Constraints(const Problem& problem, const ForwardKinematics& kinematics)
    : scene_(problem.scene),
      start_pairs_(pairs_in_contact(problem, kinematics)),
      support_(problem.scene, start_pairs_) {
  if (const ReachPose* reach = std::get_if<ReachPose>(&problem.task)) reach_target_ = reach->target;
  if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) retrieved_ = retrieve->object;
  for (const Object& object : scene_.objects) {
    centre_.push_back(object.centre_of_mass());
    p_start_.push_back(object.X_WO * centre_.back());
    up_.push_back(object.X_WO.linear().transpose() * Eigen::Vector3d::UnitZ());
  }
}

Contact Constraints::as_robot(Contact contact, Grip grip) const {
  if (grip != Grip::holding) return contact;
  if (contact.a == retrieved_) contact.a = kRobot;
  if (contact.b == retrieved_) contact.b = kRobot;
  if (contact.b < contact.a) std::swap(contact.a, contact.b);
  return contact;
}

bool Constraints::untouchable(ObjectId id, bool by_robot) const {
  if (id == reach_target_) return true;
  const Touch touch = scene_[id].constraints.touch;
  return by_robot ? !robot_may_touch(touch) : !objects_may_touch(touch);
}

bool Constraints::not_simulated(const Contact& raw, Grip grip) const {
  if (grip == Grip::none) return false;
  if (grip == Grip::closing) return raw.a == kRobot && raw.b == retrieved_;
  // Held: the world names it the robot. What it stands on it may touch until they were apart once.
  const Contact c = as_robot(raw, grip);
  if (c.a == c.b) return true;
  const ObjectId other = c.a == kRobot ? c.b : kNoObject;
  return other.valid() && start_pairs_.contains(ordered(retrieved_, other)) && !cleared_.contains(other);
}

std::optional<Violation> Constraints::judge_touch(const Contact& raw, Grip grip) const {
  if (raw.a == kFloor || raw.b == kFloor) return std::nullopt;  // it catches what falls; the support is judged
  if (not_simulated(raw, grip)) return std::nullopt;
  const Contact c = as_robot(raw, grip);
  if (start_pairs_.contains({c.a, c.b})) return std::nullopt;
  Violation v;
  v.value = c.depth;
  if (c.a == kRobot) {
    if (!untouchable(c.b, true)) return std::nullopt;
    v.kind = ViolationKind::robot_touch;
    v.object = c.b;
    v.other = kRobot;
    return v;
  }
  v.kind = ViolationKind::object_touch;
  // A fixture decides about contacts with itself; else each of two objects may forbid it.
  for (const auto& [object, other] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
    if (scene_[object].fixture() || scene_[other].fixture()) continue;
    if (!untouchable(object, false)) continue;
    v.object = object;
    v.other = other;
    return v;
  }
  for (const auto& [fixture, other] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
    if (!scene_[fixture].fixture() || !untouchable(fixture, false)) continue;
    v.object = other;
    v.other = fixture;
    return v;
  }
  return std::nullopt;
}

std::optional<Violation> Constraints::judge_object(const World& world, ObjectId id,
                                                   const std::vector<Eigen::Isometry3d>& X_WO) const {
  const Object& object = scene_[id];
  const InteractionConstraints& limits = object.constraints;
  const Eigen::Isometry3d& X = X_WO[id.index()];
  const Eigen::Vector3d centre = X * centre_[id.index()];
  const auto over = [&](ViolationKind kind, double value, double limit) {
    return std::optional<Violation>({kind, id, kNoObject, value, limit, 0});
  };

  const double tilt = std::acos(std::clamp((X.linear() * up_[id.index()]).z(), -1.0, 1.0));
  if (tilt > limits.max_tilt) return over(ViolationKind::tilt, tilt, limits.max_tilt);
  const double speed = world.linear_velocity(id).norm();
  if (speed > limits.max_speed) return over(ViolationKind::speed, speed, limits.max_speed);
  if (!limits.may_leave_support) {
    const double left = support_.left_by(id, centre, X_WO);
    if (left > 0) return over(ViolationKind::left_support, left, 0);
  }
  const double moved = (centre - p_start_[id.index()]).norm();
  if (moved > limits.max_displacement) return over(ViolationKind::displacement, moved, limits.max_displacement);
  if (object.kind == ObjectKind::immovable && moved > kImmovableTolerance)
    return over(ViolationKind::immovable_moved, moved, kImmovableTolerance);
  return std::nullopt;
}

std::optional<Violation> Constraints::judge(const World& world, const std::vector<Contact>& contacts, Grip grip) {
  for (const Contact& contact : contacts)
    if (std::optional<Violation> v = judge_touch(contact, grip)) return v;
  for (const Contact& contact : contacts) {
    if (contact.depth <= kMaxPenetration || contact.a == kFloor || contact.b == kFloor) continue;
    if (not_simulated(contact, grip)) continue;
    const Contact c = as_robot(contact, grip);
    const bool second_is_object = !scene_[c.b].fixture();
    const ObjectId object = second_is_object && (!c.a.valid() || scene_[c.a].fixture()) ? c.b : c.a;
    return Violation{ViolationKind::penetration, object, object == c.a ? c.b : c.a, c.depth, kMaxPenetration, 0};
  }
  std::vector<Eigen::Isometry3d> X_WO;
  X_WO.reserve(scene_.size());
  for (std::size_t i = 0; i < scene_.size(); ++i)
    X_WO.push_back(scene_.objects[i].fixture() ? scene_.objects[i].X_WO : world.X_WO(ObjectId(i)));
  for (ObjectId id : world.present().ids()) {
    if (!world.awake(id) || (grip == Grip::holding && id == retrieved_)) continue;
    if (std::optional<Violation> v = judge_object(world, id, X_WO)) return v;
  }
  return std::nullopt;
}

void Constraints::track_clearing(const std::vector<Contact>& contacts, Grip grip) {
  if (grip != Grip::holding) return;
  for (const auto& [a, b] : start_pairs_) {
    if (a != retrieved_ && b != retrieved_) continue;
    const bool touching = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
      return ordered(c.a, c.b) == std::pair(a, b) || ordered(c.a, c.b) == ordered(kRobot, a == retrieved_ ? b : a);
    });
    if (!touching) cleared_.insert(a == retrieved_ ? b : a);
  }
}

}  // namespace mamo::verify
