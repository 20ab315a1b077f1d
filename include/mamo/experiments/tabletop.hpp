// Seeded problems like those of the SelSim paper (section VI): reach a pose amid household things on a table.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

struct TabletopSpec {
  int movable = 10;
  int immovable = 2;
  std::uint64_t seed = 1;
  int index = 0;  // of the problem among those of this seed; a problem does not depend on how many are made
  Profile profile = Profile::contact_only;
};

/// The shipped PR2 before a table (top at z = 0.72 m), its right arm at home beside it; `movable` + `immovable` items
/// of household_items() upright, at random places and headings that do not overlap, on a strip in reach that widens
/// with their number; a goal pose of r_gripper_tool_frame inside the clutter (a random point between three random
/// objects, 5 to 12 cm above the table, any heading within 0.6 rad of straight ahead, tilted down up to 0.5 rad,
/// any roll up to a right angle).
///
/// A goal is drawn again only when no inverse-kinematics solution (all restarts) is free of the robot itself,
/// fixtures and immovables, checked as planners check an edge; after 60 such goals the scene is drawn again. No planner
/// is asked. `generated` holds generator, seed, index, goal_redraws, scene_redraws and goal_needs_contact ("yes": see
/// below, "unknown"). name and path are "tabletop-<seed>-<index>.yaml". Errors: usage (counts out of range, no room).
Result<Problem> generate_tabletop(const TabletopSpec& spec);

/// True only if no configuration within the goal's tolerances is free of contact with a movable object: the links
/// fixed to the tip, shrunk by as much as the tolerances can move them, meet one where it stands at the start.
/// False says nothing. Tasks other than ReachPose: false.
bool goal_needs_contact(const Problem& problem);

/// How many problems of a set are solvable without touching anything. The hook plans with every movable object
/// forbidden (a planner of the caller's choice) and says whether it found a path; without a hook only the
/// certain ones are counted.
struct ContactFreeCount {
  int problems = 0;
  int certainly_not = 0;  // goal_needs_contact: the hook is not asked
  int solved = 0;         // by the hook, touching nothing
  int not_solved = 0;     // the hook found nothing
  /// "of 20 problems 3 are solvable touching nothing (12 cannot be: an object stands in the goal)"
  std::string text() const;
};
ContactFreeCount count_contact_free(const std::vector<Problem>& problems,
                                    const std::function<bool(const Problem&)>& solves_untouched);

}  // namespace mamo
