// Planning notes inside a result object, both ways.
#pragma once

#include <nlohmann/json.hpp>

#include "mamo/model/planning_notes.hpp"
#include "mamo/model/scene.hpp"

namespace mamo::io {

nlohmann::ordered_json notes_to_json(const PlanningNotes& notes, const Scene& scene);
/// Lenient: what is no note is passed over, unknown objects become none.
PlanningNotes notes_from_json(const nlohmann::json& json, const Scene& scene);

}  // namespace mamo::io
