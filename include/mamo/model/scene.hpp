// Objects and fixtures around the arm, immutable during a query; where they are now is a WorldState.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mamo/common/ids.hpp"
#include "mamo/model/shape.hpp"

namespace mamo {

/// fixture: part of the world, static. immovable: a thing that must stay. movable: may be pushed.
enum class ObjectKind { fixture, immovable, movable };

/// Who may touch a body. support: a fixture that objects may touch and stand on (the robot may not).
enum class Touch { allowed, robot, objects, forbidden, support };

/// May the robot, may other objects touch a body with this setting?
constexpr bool robot_may_touch(Touch t) { return t == Touch::allowed || t == Touch::robot; }
constexpr bool objects_may_touch(Touch t) { return t == Touch::allowed || t == Touch::objects || t == Touch::support; }

/// What may happen to one object. New kinds are added here, in physics/constraint_watch and in verify.
struct InteractionConstraints {
  double max_tilt = std::numeric_limits<double>::infinity();   // rad, axis that was up at the start vs vertical
  double max_speed = std::numeric_limits<double>::infinity();  // m/s, norm, centre of mass
  bool may_leave_support = true;
  double max_displacement = std::numeric_limits<double>::infinity();  // m, centre of mass from the start
  Touch touch = Touch::allowed;
};

struct Object {
  std::string id;  // unique
  ObjectKind kind = ObjectKind::movable;
  std::vector<PlacedShape> shapes;                         // at least one; several shapes are one rigid body
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();  // at the start
  double mass = 0;                                         // kg; fixtures 0. An immovable of mass 0 is static
  double friction = 0.8;                                   // coefficient; Bullet multiplies the two of a pair
  InteractionConstraints constraints;

  bool fixture() const { return kind == ObjectKind::fixture; }
  bool movable() const { return kind == ObjectKind::movable; }
  /// Volume-weighted centre of the shapes, in the object's frame (m): the centre of mass.
  Eigen::Vector3d centre_of_mass() const;
};

/// Values that decide what the simulator computes; part of the problem, so that a result names its physics.
struct PhysicsSettings {
  double step = 1.0 / 120.0;    // s
  int iterations = 20;          // of the sequential-impulse solver
  double robot_friction = 0.5;  // coefficient of every link
  double settle_time = 2.0;     // s, the longest wait for rest after a motion
};

/// Penetration beyond this is physically implausible whoever planned it (ALGORITHMS.md). m.
inline constexpr double kMaxPenetration = 0.005;
/// An immovable moved further than this is a violation whoever did it. m.
inline constexpr double kImmovableTolerance = 0.01;

/// Immutable; ObjectId is the index, in file order.
struct Scene {
  std::vector<Object> objects;
  PhysicsSettings physics;

  std::size_t size() const { return objects.size(); }
  const Object& operator[](ObjectId id) const { return objects[id.index()]; }
  /// Invalid id when there is none of that name.
  ObjectId find(const std::string& id) const;
};

/// A set of objects of one scene, iterated in order of id.
class ObjectSet {
 public:
  ObjectSet() = default;
  explicit ObjectSet(std::size_t scene_size) : in_(scene_size, 0) {}
  /// Every object that is no fixture; only those of a kind.
  static ObjectSet all(const Scene& scene);
  static ObjectSet of_kind(const Scene& scene, ObjectKind kind);

  bool contains(ObjectId id) const { return id.valid() && id.index() < in_.size() && in_[id.index()]; }
  void insert(ObjectId id) {
    if (id.index() >= in_.size()) in_.resize(id.index() + 1, 0);
    in_[id.index()] = 1;
  }
  void erase(ObjectId id) {
    if (id.index() < in_.size()) in_[id.index()] = 0;
  }
  bool empty() const { return ids().empty(); }
  std::vector<ObjectId> ids() const {
    std::vector<ObjectId> out;
    for (std::size_t i = 0; i < in_.size(); ++i)
      if (in_[i]) out.emplace_back(i);
    return out;
  }
  friend bool operator==(const ObjectSet& a, const ObjectSet& b) { return a.ids() == b.ids(); }

 private:
  std::vector<std::uint8_t> in_;
};

}  // namespace mamo
