#include "em4m/em4m_notes.hpp"

namespace mamo {
namespace {

constexpr std::size_t kMostItems = 400;  // of a layer: a page is to stay small

std::vector<Eigen::Vector3d> on_table(const std::vector<Eigen::Vector2d>& points, double z) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector2d& p : points) out.emplace_back(p.x(), p.y(), z);
  return out;
}

std::string cause_of(const PushOutcome& outcome, const Scene& scene) {
  if (!outcome.violation) return std::string(to_string(outcome.failure));
  const Violation& v = *outcome.violation;
  std::string text(to_string(v.kind));
  if (v.object.valid()) text += " of " + scene[v.object].id;
  char number[64];
  std::snprintf(number, sizeof number, ": %.3g, limit %.3g %s", v.value, v.limit, std::string(unit_of(v.kind)).c_str());
  return text + number;
}

}  // namespace

void Em4mNotes::region(const VoxelVolume& region) {
  region_.cells.cell = region.cell();
  region_.cells.origin = region.origin();
  for (int k = 0; k < region.size().z(); ++k)
    for (int j = 0; j < region.size().y(); ++j)
      for (int i = 0; i < region.size().x(); ++i)
        if (region.contains(Eigen::Vector3i(i, j, k))) region_.cells.indices.push_back({i, j, k});
}

void Em4mNotes::paths(int expansion, const std::vector<ObjectPath>& paths, const WorldState& state) {
  for (const ObjectPath& path : paths) {
    if (paths_.items.size() >= kMostItems) return;
    paths_.items.push_back({problem_.scene[path.object].id + " goes",
                            on_table(path.points, state.X_WO(path.object).translation().z()), path.object, expansion});
  }
}

void Em4mNotes::failed(int expansion, const ObjectPath& path, const PushOutcome& outcome, const WorldState& state) {
  if (failed_.items.size() >= kMostItems) return;
  failed_.items.push_back({"push of " + problem_.scene[path.object].id + ": " + cause_of(outcome, problem_.scene),
                           on_table(path.points, state.X_WO(path.object).translation().z()), path.object, expansion});
}

PlanningNotes Em4mNotes::take() {
  PlanningNotes notes;
  for (NoteLayer* layer : {&region_, &paths_, &failed_})
    if (!layer->items.empty() || !layer->cells.indices.empty()) notes.layers.push_back(std::move(*layer));
  return notes;
}

}  // namespace mamo
