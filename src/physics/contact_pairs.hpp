// Narrow phase: the contact points of every pair of bodies that are near each other, kept from step to step.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

class btCollisionObject;
class btCollisionAlgorithm;
class btDispatcher;
class btPersistentManifold;

namespace mamo {

/// Pairs are named by indices a < b of bodies, and always visited in order of (a, b): what the solver sees never
/// depends on the order in which pairs came about. Contact points persist while a pair is visited step by step.
class ContactPairs {
 public:
  struct Pair {
    std::uint32_t key = 0;  // a * bodies + b
    std::uint32_t stamp = 0;
    btCollisionAlgorithm* algorithm = nullptr;
    btPersistentManifold* predicted = nullptr;     // of this step only
    std::vector<btPersistentManifold*> manifolds;  // compounds have several; possibly without points
    int points = 0;                                // contact points in all of them
  };

  /// Pairs that can come closer by more than this in one step (m) get predicted contact points too.
  static constexpr double kFastTravel = 0.002;

  /// For bodies 0 .. count-1; the pointers are kept.
  explicit ContactPairs(const std::vector<btCollisionObject*>& bodies);
  ~ContactPairs();
  ContactPairs(const ContactPairs&) = delete;

  /// Forgets every contact.
  void clear();

  int first(const Pair& p) const { return static_cast<int>(p.key / count_); }
  int second(const Pair& p) const { return static_cast<int>(p.key % count_); }
  std::uint32_t key(int a, int b) const {
    return static_cast<std::uint32_t>(a) * count_ + static_cast<std::uint32_t>(b);
  }

  /// Starts a step of step_s seconds in which `keys` (sorted, unique) are near each other: finds their contact
  /// points. travel: how far any point of each body can get in this step at its present velocity (m).
  void collide(const std::vector<std::uint32_t>& keys, const std::vector<double>& travel, double step_s);
  /// Pairs visited by the last collide(), in order.
  const std::vector<Pair*>& visited() const { return visited_; }
  /// Pairs that hold contact points, visited or not, in no particular order.
  const std::vector<Pair*>& live() const { return live_; }
  /// The deepest point that touches (distance <= 0, or it carries a force), if any.
  struct TouchPoint {
    double depth;         // m, >= 0
    Eigen::Vector3d p_W;  // m, on the second body
  };
  static std::optional<TouchPoint> touch_point(const Pair& pair);
  /// Forgets pairs that the last collide() did not visit and for which `stale` says so.
  template <class Predicate>
  void forget(Predicate stale) {
    for (std::size_t i = live_.size(); i-- > 0;)
      if (live_[i]->stamp != stamp_ && stale(first(*live_[i]), second(*live_[i]))) remove(i);
  }

  /// Forgets all pairs for which `stale` says so.
  template <class Predicate>
  void drop(Predicate stale) {
    std::erase_if(visited_, [&](const Pair* p) { return stale(first(*p), second(*p)); });
    for (std::size_t i = live_.size(); i-- > 0;)
      if (stale(first(*live_[i]), second(*live_[i]))) remove(i);
  }

  btDispatcher* dispatcher();

  /// Distance of two bodies (m) if it is below `limit`, else infinity; negative when they overlap. Uses their
  /// present transforms; changes nothing.
  double distance(int a, int b, double limit);

 private:
  struct Bullet;
  void remove(std::size_t live_index);
  void predict(Pair& pair, double travel, double step_s);
  void gather(Pair& pair);
  std::uint32_t count_, stamp_ = 0;
  std::vector<btCollisionObject*> bodies_;
  std::unique_ptr<Bullet> bullet_;
  std::vector<std::unique_ptr<Pair>> table_;  // by key
  std::vector<Pair*> live_, visited_;
};

}  // namespace mamo
