// FCL behind one class: the robot against the scene and against itself, at a configuration or along an edge.
#pragma once

#include <Eigen/Geometry>

#include <memory>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo {

struct CollisionOptions {
  /// No collision point of the arm moves further than this between two checked configurations (m).
  double edge_step = 0.002;
  /// Watched objects are inflated by this when an edge is classified: at least half the edge step plus what the
  /// simulator calls contact (m). What is forbidden is not inflated: a start or a goal may be close to a wall, and
  /// the fine step is what keeps the arm out of it between two checks.
  double padding = 0.003;
};

/// What a configuration or an edge hits. Bodies the caller asked about, in order of id.
struct CollisionReport {
  bool self = false;  // two links of the robot (first_self names them)
  std::pair<LinkId, LinkId> first_self;
  std::vector<ObjectId> touched;  // sorted, unique
  /// Of an edge: the smallest checked parameter (0 at q0, 1 at q1) at which a watched object is touched; else 2.
  double first_touch = 2;
  bool free() const { return !self && touched.empty(); }
};

/// One instance per worker (it holds scratch); geometry is immutable. Answers do not depend on earlier calls but
/// for set_state, attach and detach. Links that no group joint moves are not tested against objects: nothing that a
/// plan decides changes their contacts (a base may stand on its table).
/// Fixtures and every object are known from construction; which count is said per call.
class CollisionChecker {
 public:
  CollisionChecker(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene,
                   const CollisionOptions& options = {});
  ~CollisionChecker();
  CollisionChecker(const CollisionChecker&) = delete;

  /// Puts the objects where `state` says. Only those whose pose changed cost time.
  void set_state(const WorldState& state);

  /// Robot against itself and against every object in `against` (fixtures too, if listed), unpadded.
  /// stop_at_first: return as soon as anything is hit.
  void check(const Eigen::VectorXd& q, const ObjectSet& against, bool stop_at_first, CollisionReport& out);

  /// The straight edge from q0 to q1 (linear in joints), coarse to fine, both ends included.
  /// Self-collision and bodies in `forbidden` end the check at once (report.self, or touched holds that
  /// body, and the return value is false). Bodies in `watched` are padded and collected in report.touched.
  bool check_edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const ObjectSet& forbidden,
                  const ObjectSet& watched, CollisionReport& out);

  /// The parameters in [0, 1] that check_edge looks at, ascending.
  std::vector<double> edge_samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);

  /// An object rigidly attached to a link counts as robot from now on (X_LO: object in link), no longer as an
  /// object, and is tested against the links that self_pairs has for that link; detach ends it.
  void attach(ObjectId object, LinkId link, const Eigen::Isometry3d& X_LO);
  void detach();

  /// Objects overlapping one another by more than `tolerance` (m) at the current state; pairs a < b.
  std::vector<std::pair<ObjectId, ObjectId>> overlapping_objects(double tolerance);

  /// Configurations at which the arm was posed so far; an edge proven free from its middle poses it once.
  std::int64_t checks() const;
  const CollisionOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Pairs of links that a Robot should test: all pairs of links with shapes of which at least one moves, less
/// `disabled` (SRDF), less adjacent ones, less those that collide at the start configuration or in at least
/// 95 % of seeded samples (returned in robot.disabled_pairs). Fills robot.self_pairs.
/// adjacent_only_from_srdf: when an SRDF was given its list is complete and nothing is sampled.
void choose_self_pairs(Robot& robot, const std::vector<std::pair<LinkId, LinkId>>& disabled, bool srdf_given,
                       std::uint64_t seed);

}  // namespace mamo
