// How hard a retrieval is, as the E-M4M paper classes it: by how many movable objects stand in the way.
#pragma once

#include <optional>
#include <string_view>

#include "mamo/collision/voxel_volume.hpp"
#include "mamo/model/problem.hpp"

namespace mamo {

/// "Experimental Analysis" of the paper: one, two, or more than two movables overlap the negative goal region.
enum class Difficulty { none, easy, medium, hard };
std::string_view to_string(Difficulty difficulty);
std::optional<Difficulty> parse_difficulty(std::string_view name);
Difficulty difficulty_of(int movables_in_the_way);

/// The volume that arm and carried object sweep in the first retrieval found as if there were no movables (the negative
/// goal region); nothing when none is found. The task must be Retrieve. Repeats: its effort is counted, not timed.
std::optional<VoxelVolume> retrieval_region(const Problem& problem);
/// Movables, the object to be retrieved left out, of which at least one cell lies in the region.
int movables_in(const VoxelVolume& region, const Problem& problem);
/// What the file's generator noted, else computed; nothing for other tasks and where no retrieval is found.
std::optional<Difficulty> difficulty(const Problem& problem);

}  // namespace mamo
