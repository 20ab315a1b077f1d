// What selective simulation shows of its work: which motions the replays refuted, which objects that made relevant, and
// the grid heuristic. Only looked at.
#pragma once

#include <string>
#include <vector>

#include "mamo/lattice/manipulation_lattice.hpp"
#include "mamo/model/planning_notes.hpp"
#include "mamo/selsim/tracker.hpp"

namespace mamo {

class SelSimNotes {
 public:
  /// iteration: of planning, from 1. from, to: the motion's ends. state: the objects before it.
  void refuted(int iteration, const Problem& problem, const ForwardKinematics& kinematics, const Eigen::VectorXd& from,
               const Eigen::VectorXd& to, const WorldState& state, const Violation& violation);
  /// became: kNoObject when nothing more could be learned. Call it after refuted().
  void learned(ObjectId became);
  PlanningNotes take(const Problem& problem, const LatticeModel& model) const;

 private:
  struct Refuted {
    int iteration;
    Violation violation;
    std::vector<Eigen::Vector3d> tip;  // along the motion
    WorldState state;
    ObjectId became = kNoObject;
  };
  std::vector<Refuted> refuted_;
};

}  // namespace mamo
