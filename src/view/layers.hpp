// The layers that a page can show: what the planner noted, and what follows from the replay itself.
#pragma once

#include "view/stage.hpp"

namespace mamo::view {

/// The planner's notes first; then the tip's path, the objects' paths and the volume that the arm swept, from the
/// recording.
std::vector<NoteLayer> page_layers(const Stage& stage);

/// Path of the tip by segment, and of each object that moved further than a centimetre: for pictures and pages alike.
NoteLayer tip_path(const Stage& stage);
NoteLayer object_paths(const Stage& stage);

}  // namespace mamo::view
