// Everything that may not happen during a motion, checked after every step. A new kind of constraint is a field of
// InteractionConstraints, a ViolationKind, and one row in constraint_watch.cpp.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mamo/model/interaction.hpp"
#include "mamo/physics/evaluation.hpp"
#include "physics/support_rule.hpp"

namespace mamo {

/// Facts about the scene's start that the constraints refer to, and the constraints. One instance per worker.
class ConstraintWatch {
 public:
  /// The scene must outlive the watch. `touching`: pairs (a < b) that touch at the scene's start.
  ConstraintWatch(const Scene& scene, const std::vector<std::pair<ObjectId, ObjectId>>& touching);

  /// A motion begins. `under_held`: what the held object touches now and may touch until it first clears it.
  void begin(const EvaluationRequest& request, std::set<ObjectId> under_held);

  /// The first violation, by kind, then by ids, of what the world shows after a step; time_s is not filled in.
  std::optional<Violation> check(const World& world, const std::vector<Contact>& contacts);

 private:
  struct ObjectRow;
  struct Facts {
    Eigen::Vector3d up;      // the axis that is vertical at the start, in the object's frame
    Eigen::Vector3d centre;  // of mass, in the object's frame (m)
    Eigen::Vector3d p_start; // of mass, at the start, in world (m)
  };
  static const std::vector<ObjectRow>& object_rows();

  void check_contact(const Contact& c, std::vector<Violation>& found) const;
  void check_object(const World& world, ObjectId id, std::vector<Violation>& found) const;
  bool robot_may_touch(ObjectId id) const;
  bool objects_may_touch(ObjectId id) const;
  void clear_held(const std::vector<Contact>& contacts);

  const Scene& scene_;
  std::set<std::pair<ObjectId, ObjectId>> start_pairs_;
  SupportRule support_;
  std::vector<Facts> facts_;
  ObjectId untouchable_ = kNoObject, held_ = kNoObject;
  std::set<ObjectId> under_held_;
};

}  // namespace mamo
