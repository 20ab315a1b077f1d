// One motion of a retrieval against what is in its way, according to what the arm does with the object.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/lattice/joint_path.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::retrieval {

/// What a retrieval has around it, whatever the movable objects do.
struct Surroundings {
  Surroundings(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics_in,
               double max_object_tilt_rad);

  const Retrieve& task() const { return std::get<Retrieve>(problem.task); }

  const Problem& problem;
  std::shared_ptr<const ForwardKinematics> kinematics;
  double max_object_tilt;  // rad
  ObjectSet fixtures;
  ObjectSet immovables;  // less the object itself
};

enum class Phase {
  approach,  // empty-handed, the object stands in the way
  reach,     // empty-handed, the object may be touched
  leave,     // held, and may still touch what it stood on
  carry,     // held
};

/// Checks edges and paths for one placement of the objects. Fixtures are avoided as they are, objects with the
/// checker's padding. Leaves the checker with nothing attached.
class Legs {
 public:
  /// Puts the checker's objects where `state` says.
  Legs(const Surroundings& around, CollisionChecker& checker, const WorldState& state, const ObjectSet& obstacles);
  ~Legs() { checker_.detach(); }
  Legs(const Legs&) = delete;

  /// The object is held as it stands by the arm at q, in the phases that hold it.
  void grip(const Eigen::VectorXd& q_grasp);

  bool free(Phase phase, const Eigen::VectorXd& a, const Eigen::VectorXd& b);
  bool free(Phase phase, const Eigen::VectorXd& q) { return free(phase, q, q); }
  bool free(Phase phase, const std::vector<Eigen::VectorXd>& path);
  /// Number of points that can be reached one after the other; at least 1 if the first one is free, else 0.
  std::size_t free_points(Phase phase, const std::vector<Eigen::VectorXd>& path);
  /// Adds to `touched` those of the obstacles and immovables that the motion touches.
  void collect(Phase phase, const Eigen::VectorXd& a, const Eigen::VectorXd& b, ObjectSet& touched);
  /// How far the held object would be tilted against its stand (rad).
  double tilt(const Eigen::VectorXd& q) const;

  /// From `from` to one of `goals`; the tilt of what is held stays below its limit. Empty if none is found.
  std::vector<Eigen::VectorXd> search(Phase phase, const Eigen::VectorXd& from, std::vector<Eigen::VectorXd> goals,
                                      RandomStream random, const JointPathOptions& options, StopSource* stop);

  /// What the last edge that was not free hit: the id of an object, or "itself".
  const std::string& hit() const { return hit_; }

 private:
  bool edge(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const ObjectSet& forbidden, const ObjectSet& avoided);
  void hold(bool held);

  const Surroundings& around_;
  CollisionChecker& checker_;
  WorldState state_;
  ObjectSet avoided_, avoided_with_object_;   // immovables and obstacles; and the object itself
  ObjectSet supports_;                        // touch the object where it stands
  ObjectSet fixtures_clear_, avoided_clear_;  // less the supports
  Eigen::Isometry3d X_TO_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d up_T_{0, 0, 1};  // the vertical at the grasp, in the tip
  bool held_ = false;
  CollisionReport report_;
  std::string hit_;
};

}  // namespace mamo::retrieval
