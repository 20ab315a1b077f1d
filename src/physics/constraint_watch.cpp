#include "physics/constraint_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace mamo {

/// One kind of constraint on the motion of a single object: a measured value must not exceed a limit.
struct ConstraintWatch::ObjectRow {
  struct Subject {
    const ConstraintWatch& watch;
    const World& world;
    const Object& object;
    const Facts& facts;
    ObjectId id;
    Eigen::Isometry3d X_WO;
    Eigen::Vector3d p_WCm;  // centre of mass
  };
  ViolationKind kind;
  double (*limit)(const Object& object);
  double (*value)(const Subject& s);
};

const std::vector<ConstraintWatch::ObjectRow>& ConstraintWatch::object_rows() {
  using Subject = ObjectRow::Subject;
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  static const std::vector<ObjectRow> rows = {
      {ViolationKind::tilt, [](const Object& o) { return o.constraints.max_tilt; },
       [](const Subject& s) { return std::acos(std::clamp((s.X_WO.linear() * s.facts.up).z(), -1.0, 1.0)); }},
      {ViolationKind::speed, [](const Object& o) { return o.constraints.max_speed; },
       [](const Subject& s) { return s.world.linear_velocity(s.id).norm(); }},
      {ViolationKind::left_support, [](const Object& o) { return o.constraints.may_leave_support ? kNone : 0.0; },
       [](const Subject& s) {
         const auto X_WO = [&](ObjectId id) {
           return s.world.present().contains(id) ? s.world.X_WO(id) : s.watch.scene_[id].X_WO;
         };
         return s.watch.support_.left_by(s.id, s.p_WCm, X_WO);
       }},
      {ViolationKind::displacement, [](const Object& o) { return o.constraints.max_displacement; },
       [](const Subject& s) { return (s.p_WCm - s.facts.p_start).norm(); }},
      {ViolationKind::immovable_moved,
       [](const Object& o) { return o.kind == ObjectKind::immovable ? kImmovableTolerance : kNone; },
       [](const Subject& s) { return (s.p_WCm - s.facts.p_start).norm(); }},
  };
  return rows;
}

ConstraintWatch::ConstraintWatch(const Scene& scene, const std::vector<std::pair<ObjectId, ObjectId>>& touching)
    : scene_(scene), start_pairs_(touching.begin(), touching.end()), support_(scene, touching) {
  for (const Object& o : scene.objects) {
    const Eigen::Vector3d centre = o.centre_of_mass();
    facts_.push_back({o.X_WO.linear().transpose() * Eigen::Vector3d::UnitZ(), centre, o.X_WO * centre});
  }
}

void ConstraintWatch::begin(const EvaluationRequest& request, std::set<ObjectId> under_held) {
  untouchable_ = request.untouchable;
  held_ = request.held;
  under_held_ = std::move(under_held);
}

std::optional<Violation> ConstraintWatch::check(const World& world, const std::vector<Contact>& contacts) {
  std::vector<Violation> found;
  for (const Contact& c : contacts) check_contact(c, found);
  if (held_.valid()) clear_held(contacts);
  for (const ObjectId id : world.present().ids())
    if (id != held_ && world.awake(id)) check_object(world, id, found);
  const auto first = std::min_element(found.begin(), found.end(), [](const Violation& x, const Violation& y) {
    return std::tie(x.kind, x.object, x.other) < std::tie(y.kind, y.object, y.other);
  });
  if (first == found.end()) return std::nullopt;
  return *first;
}

bool ConstraintWatch::robot_may_touch(ObjectId id) const {
  return id != untouchable_ && mamo::robot_may_touch(scene_[id].constraints.touch);
}

bool ConstraintWatch::objects_may_touch(ObjectId id) const {
  return id != untouchable_ && mamo::objects_may_touch(scene_[id].constraints.touch);
}

void ConstraintWatch::check_contact(const Contact& c, std::vector<Violation>& found) const {
  if (c.a == kFloor) return;  // it catches what falls; leaving the support is another row
  if (c.a == kRobot) {
    if (under_held_.contains(c.b)) return;
    if (!robot_may_touch(c.b)) found.push_back({ViolationKind::robot_touch, c.b, kRobot, c.depth, 0, 0});
    if (c.depth > kMaxPenetration)
      found.push_back({ViolationKind::penetration, c.b, kRobot, c.depth, kMaxPenetration, 0});
    return;
  }
  // Fixtures are no nodes of the interaction tree: then the object itself is what the constraint is about. Of two
  // objects it is the one that must not be touched; ids order the rest.
  const bool swap = scene_[c.a].fixture() || (!scene_[c.b].fixture() && objects_may_touch(c.a) && !objects_may_touch(c.b));
  const ObjectId object = swap ? c.b : c.a, other = swap ? c.a : c.b;
  if (!(objects_may_touch(c.a) && objects_may_touch(c.b)) && !start_pairs_.contains({c.a, c.b}))
    found.push_back({ViolationKind::object_touch, object, other, c.depth, 0, 0});
  if (c.depth > kMaxPenetration) {
    const ObjectId moved = scene_[c.a].fixture() ? c.b : c.a;
    found.push_back({ViolationKind::penetration, moved, moved == c.a ? c.b : c.a, c.depth, kMaxPenetration, 0});
  }
}

void ConstraintWatch::check_object(const World& world, ObjectId id, std::vector<Violation>& found) const {
  const Object& object = scene_[id];
  const Facts& facts = facts_[id.index()];
  const Eigen::Isometry3d X_WO = world.X_WO(id);
  const ObjectRow::Subject subject{*this, world, object, facts, id, X_WO, X_WO * facts.centre};
  for (const ObjectRow& row : object_rows()) {
    const double limit = row.limit(object);
    if (limit == std::numeric_limits<double>::infinity()) continue;
    const double value = row.value(subject);
    if (value > limit) found.push_back({row.kind, id, kNoObject, value, limit, 0});
  }
}

void ConstraintWatch::clear_held(const std::vector<Contact>& contacts) {
  std::erase_if(under_held_, [&](ObjectId id) {
    return std::none_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return c.a == kRobot && c.b == id; });
  });
}

}  // namespace mamo
