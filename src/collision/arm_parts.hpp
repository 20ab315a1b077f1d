// The robot as solids: one part per collision shape, plus those of a held object.
#pragma once

#include <memory>
#include <vector>

#include "arm_travel.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/scene.hpp"

namespace mamo::collision {

struct ArmPart {
  LinkId link;
  bool moves;
  Solid solid;
  Eigen::Isometry3d X_LS;
  bool turned;  // X_LS has a rotation
};

struct SelfPair {
  int a, b;       // parts
  LinkId la, lb;  // la < lb
};

/// Parts in the order in which they are worth testing: the held object, then links from the tip down, then links that
/// do not move (they take part in self pairs only).
class ArmParts {
 public:
  explicit ArmParts(const ForwardKinematics& kinematics);

  void hold(const Object& object, LinkId link, const Eigen::Isometry3d& X_LO);
  void release();

  const std::vector<ArmPart>& parts() const { return parts_; }
  const std::vector<SelfPair>& self_pairs() const { return self_; }
  /// Indices of the parts that move, in the order of testing.
  const std::vector<int>& moving() const { return moving_; }
  ArmTravel& travel() { return travel_; }

  Placed placed(int part, const std::vector<Eigen::Isometry3d>& X_WL) const;

 private:
  void add_self_pair(int a, int b);
  bool rigid_with(LinkId a, LinkId b) const { return rigid_group_[a.index()] == rigid_group_[b.index()]; }

  const Robot& robot_;
  std::vector<int> rigid_group_;
  std::vector<ArmPart> parts_;
  std::vector<SelfPair> self_;
  std::vector<int> moving_, own_moving_;
  std::size_t own_parts_ = 0, own_self_ = 0;
  ArmTravel travel_;
};

/// Links that keep their place relative to one another, whatever the group joints do, share a number.
std::vector<int> rigid_groups(const Robot& robot);

}  // namespace mamo::collision
