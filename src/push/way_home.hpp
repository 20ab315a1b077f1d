// From inside the clutter to the resting configuration, and back, touching nothing.
#pragma once

#include <vector>

#include "push/push_bodies.hpp"
#include "push/tip_follower.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/random.hpp"
#include "mamo/common/stop.hpp"

namespace mamo::push {

/// Holds scratch; answers depend on the arguments and on the checker's state only.
class WayHome {
 public:
  WayHome(const Problem& problem, const ForwardKinematics& kinematics, const PushBodies& bodies,
          CollisionChecker& checker);

  /// A few ways that cost little: the straight edge, and drawing the tip out towards where it rests, in several
  /// directions, until the straight edge is free. From q to rest; empty when none is free.
  std::vector<Eigen::VectorXd> quick(const Eigen::VectorXd& q);
  /// RRT-Connect with a budget of nodes. From q to rest; empty when the budget is used up.
  std::vector<Eigen::VectorXd> search(const Eigen::VectorXd& q, RandomStream random, int nodes, StopSource* stop);

  /// Neither what is forbidden nor (padded) any object is touched on the edge.
  bool free(const Eigen::VectorXd& a, const Eigen::VectorXd& b);
  bool free(const std::vector<Eigen::VectorXd>& path);

 private:
  std::vector<Eigen::VectorXd> drawn_out(const Eigen::VectorXd& q, const Eigen::Vector3d& detour);
  void shorten(std::vector<Eigen::VectorXd>& path);

  const Problem& problem_;
  const ForwardKinematics& kinematics_;
  const PushBodies& bodies_;
  CollisionChecker& checker_;
  ObjectSet objects_;  // all but fixtures
  TipFollower follower_;
  Eigen::Isometry3d X_WT_rest_;
  Eigen::Vector2d p_shoulder_;
  CollisionReport report_;
};

}  // namespace mamo::push
