// What a planner returns: segments of timed joint motion with predicted object poses, and how it went.
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mamo/common/ids.hpp"
#include "mamo/model/interaction.hpp"
#include "mamo/model/motion.hpp"
#include "mamo/model/planning_notes.hpp"

namespace mamo {

enum class SegmentKind { approach, push, retreat, reach, grasp, extract };
std::string_view to_string(SegmentKind kind);

/// One piece of a plan. `motion.q` has one value per name in joint_names; the first q equals the last one
/// of the segment before. objects_after: pose of every object that is no fixture, at the segment's end.
struct Segment {
  SegmentKind kind = SegmentKind::reach;
  ObjectId object = kNoObject;
  std::vector<std::string> joint_names;
  TimedPath motion;
  std::map<ObjectId, Eigen::Isometry3d> objects_after;
};

struct Plan {
  std::vector<Segment> segments;
  bool empty() const { return segments.empty(); }
};

enum class PlanStatus { solved, limit, timeout, proven, interrupted, memory, invalid, error };
std::string_view to_string(PlanStatus status);
/// 0, 1, 2, 3 or 70 (INTERFACE, exit codes).
int exit_code(PlanStatus status);

/// Everything but the times, `simulations` and the memory is what the serial run counts, at any thread count.
struct PlanStats {
  double wall_s = 0, found_s = 0, load_s = 0, search_s = 0, tracking_s = 0, verification_s = 0;
  std::int64_t simulations = 0, simulations_used = 0, tracking_simulations = 0;
  double simulation_s = 0;  // summed over workers
  std::int64_t collision_checks = 0, expansions = 0;
  int planning_iterations = 0;
  std::vector<ObjectId> relevant_objects;  // in the order in which they became relevant
  std::int64_t mapf_calls = 0;
  double mapf_s = 0;
  std::int64_t push_attempts = 0;
  double push_planning_s = 0;
  std::int64_t cache_hits = 0;
  double peak_memory_mb = 0;
  std::map<std::string, std::int64_t> failures;  // cause -> count
};

struct PlanResult {
  PlanStatus status = PlanStatus::error;
  std::string reason;  // one line; empty when solved
  std::string planner;
  std::uint64_t seed = 1;
  int threads = 1;
  std::uint64_t signature = 0;     // of the committed expansion order and the plan
  std::int64_t cost = 0;           // milliradians
  double suboptimality_bound = 0;  // 0: none claimed
  bool found = false;              // the paper's own definition of success
  bool verified = false;
  int rejected_by_verification = 0;
  bool second_order_contacts = false;
  PlanStats stats;
  Plan plan;
  PlanningNotes notes;  // only when PlanOptions::explain asks for it
};

}  // namespace mamo
