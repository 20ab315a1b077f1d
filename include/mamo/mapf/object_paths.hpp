// Movable objects as agents: which have to go where so that the negative goal region is free (E-M4M, "MAPF
// Abstraction"). Conflict-based search over a 4-connected grid, exact footprints at the present orientation.
#pragma once

#include <Eigen/Core>

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "mamo/collision/voxel_volume.hpp"
#include "mamo/common/stop.hpp"
#include "mamo/model/problem.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo {

/// Cell of the agents' grid: where the object's centre (origin of its frame) is. Cells are lattice points k * cell of
/// the world's x and y axes.
struct GridCell {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const GridCell&, const GridCell&) = default;
};

/// Goals of one object that led to no push: an exact hit is never a goal; in their neighbourhood a goal costs more
/// (EM4M_FACTS section 4: ceil(sum of count / ceil(distance in cells)) over |dx|, |dy| <= 2), if penalties are on.
using InvalidGoals = std::map<GridCell, int>;  // -> number of failed samples

struct ObjectPathsOptions {
  double cell = 0.01;                     // m
  bool neighbour_penalties = true;        // off: only exact hits count (ablation posdb)
  double suboptimality = 2.0;             // of both levels (ECBS); doubled twice at most, as the budget runs out
  double clearance = 0.15;                // m, of the conflict heuristic that keeps paths away from what stays
  std::int64_t max_expansions = 200'000;  // low-level expansions of one call
  int max_nodes = 2'000;                  // high-level nodes of one call
};

/// Path of one object that has to move. The first point is the object's present position; the others are cell centres.
struct ObjectPath {
  ObjectId object;
  GridCell goal;                        // last cell: the key of invalid goals and of the data base of pushes
  std::vector<GridCell> cells;          // one per time step, waits included; at least two
  std::vector<Eigen::Vector2d> points;  // shortcut, waits dropped, line of sight against what stays: at least two (m)
};

struct ObjectPathsResult {
  bool solved = false;
  bool stopped = false;
  bool budget_used_up = false;    // not solved, but not proven unsolvable either
  std::vector<ObjectPath> paths;  // in order of object id; empty: nobody has to move. With the budget used up: the
                                  // least conflicting ones, for want of better
  std::int64_t cost = 0;
  std::int64_t low_level_expansions = 0, high_level_nodes = 0;
  std::vector<ObjectId> stuck;  // objects without any path of their own (when unsolved)
};

/// Immutable after construction (what stays is rasterised once per problem and footprint); calls may run on several
/// threads at once, each with its own scratch inside. Depends on the arguments only.
class ObjectPathFinder {
 public:
  /// What stays, where the scene has it: fixtures, immovables and `target` (the object of interest). The problem must
  /// outlive the finder.
  ObjectPathFinder(const Problem& problem, ObjectId target, const ObjectPathsOptions& options);
  ~ObjectPathFinder();

  /// All movables but the target are agents; those outside the region that nobody disturbs cost no time.
  /// `region`: negative goal region. `invalid`: per object, missing means none.
  ObjectPathsResult solve(const WorldState& state, const VoxelVolume& region,
                          const std::map<ObjectId, InvalidGoals>& invalid, StopSource* stop) const;

  /// Is the object clear of the region as the path finding judges it (footprint times height)?
  bool clear_of(const VoxelVolume& region, ObjectId object, const WorldState& state) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mamo
