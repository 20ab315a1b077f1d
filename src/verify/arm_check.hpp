// The arm against what never moves and against itself, sampled densely: the simulator makes no contacts between
// kinematic and static bodies (PHYSICS.md section 10), so somebody has to look.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "verify/solid.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/interaction.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::verify {

/// What the arm hit: a body, or itself (then `other_link` is valid and body is kRobot).
struct ArmHit {
  double fraction = 0;  // of the piece, 0..1
  ObjectId body;
  LinkId link, other_link;
  bool held = false;  // the held object hit it, not a link
};

/// Unpadded shapes, boolean overlap. Links that no group joint moves are left out against static bodies: the plan
/// cannot change what they touch (a base bolted to a table).
class ArmCheck {
 public:
  /// `step` (m): no collision point of the arm moves further between two samples of a piece.
  ArmCheck(const Problem& problem, const ForwardKinematics& kinematics, double step);

  /// The first hit on the straight motion from q0 to q1, both ends included.
  std::optional<ArmHit> along(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);

  /// Does some moving link at q come within `margin` metres of the object at X_WO?
  bool reaches(const Eigen::VectorXd& q, const Object& object, const Eigen::Isometry3d& X_WO, double margin);

  /// From now on the object moves with the link. It may touch the bodies of `support`, up to kMaxPenetration deep,
  /// until it has been clear of each once.
  void hold(const Object& object, LinkId link, const Eigen::Isometry3d& X_LO, std::set<ObjectId> support);
  /// First hit of the held object with a static body on the straight motion from q0 to q1.
  std::optional<ArmHit> held_along(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);

 private:
  struct MovingLink {
    LinkId id;
    std::vector<Solid> solids;
    Eigen::VectorXd travel;  // m per unit of each group joint, an upper bound
  };
  struct StaticBody {
    ObjectId id;
    bool touchable;  // by the robot
    std::vector<Solid> solids;
  };
  struct Held {
    LinkId link;
    Eigen::Isometry3d X_LO;
    std::vector<Solid> solids, grown, shrunk;
    Eigen::VectorXd travel;
    std::set<ObjectId> support;
  };

  int samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const Eigen::VectorXd* travel) const;
  std::optional<ArmHit> at(const Eigen::VectorXd& q);
  std::optional<ArmHit> held_at(const Eigen::VectorXd& q);

  const ForwardKinematics& kinematics_;
  double step_;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<MovingLink> links_;
  std::vector<std::vector<Solid>> self_;  // per link of the model; empty where no self pair needs it
  std::vector<StaticBody> statics_;
  std::optional<Held> held_;
};

}  // namespace mamo::verify
