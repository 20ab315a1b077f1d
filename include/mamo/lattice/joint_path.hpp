// A path of the arm that touches nothing, between configurations: RRT-Connect (Kuffner, LaValle 2000), seeded and
// budgeted in nodes. Approaches, retreats, extractions and goal chains are all found by this.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/random.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

struct JointPathOptions {
  int max_nodes = 4000;  // both trees together, failed extensions count a quarter
  double step = 0.25;    // rad or m (Euclidean) of one tree edge
  int shortcuts = 60;    // attempts to shorten the path
  bool direct = true;    // try straight edges to the goals first (several paths of one query would be the same)
};

/// What a path joins and what it keeps clear of.
struct JointPathQuery {
  Eigen::VectorXd start;
  std::vector<Eigen::VectorXd> goals;  // at least one; the first one reached ends the search
  ObjectSet forbidden;                 // bodies not to be touched, unpadded
  ObjectSet avoided;                   // bodies not to be touched even when padded (CollisionOptions::padding)
  /// Optional further condition on configurations; asked every `accept_step` along an edge.
  std::function<bool(const Eigen::VectorXd&)> accept;
  double accept_step = 0.05;  // rad or m (Euclidean)
};

/// Configurations from start to a goal, straight edges between them; empty when the budget is used up, the stop source
/// fires, or the start is in collision. `checker` holds the objects' state and what is attached; it is left
/// so. Depends on the arguments only.
std::vector<Eigen::VectorXd> find_joint_path(const Robot& robot, CollisionChecker& checker, const JointPathQuery& query,
                                             RandomStream random, const JointPathOptions& options, StopSource* stop);

/// The same points with others between them, so that neighbours are no further apart than `spacing` (rad or m).
std::vector<Eigen::VectorXd> subdivided(const std::vector<Eigen::VectorXd>& path, double spacing);

}  // namespace mamo
