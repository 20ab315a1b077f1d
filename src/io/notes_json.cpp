#include "io/notes_json.hpp"

#include <cmath>

namespace mamo::io {
namespace {

using Json = nlohmann::ordered_json;
using Input = nlohmann::json;

double rounded(double metres) { return std::round(metres * 1e5) / 1e5; }

Json point(const Eigen::Vector3d& p) { return Json{rounded(p.x()), rounded(p.y()), rounded(p.z())}; }

Json item_object(const NoteItem& item, const Scene& scene) {
  Json out{{"text", item.text}};
  if (item.object.valid() && item.object.index() < scene.size()) out["object"] = scene[item.object].id;
  if (item.iteration >= 0) out["iteration"] = item.iteration;
  out["points"] = Json::array();
  for (const Eigen::Vector3d& p : item.points) out["points"].push_back(point(p));
  return out;
}

/// One flat list of i, j, k: a third of the brackets.
Json cells_object(const NoteCells& cells) {
  Json out{{"cell", cells.cell}, {"origin", point(cells.origin)}};
  out["indices"] = Json::array();
  for (const auto& index : cells.indices)
    for (int i : index) out["indices"].push_back(i);
  if (!cells.values.empty()) {
    out["values"] = Json::array();
    for (double v : cells.values) out["values"].push_back(std::round(v * 1e3) / 1e3);
  }
  return out;
}

double number(const Input& json, const char* key, double otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

std::string text(const Input& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Empty when it is no list.
const Input& list(const Input& json, const char* key) {
  static const Input kNone = Input::array();
  const auto found = json.find(key);
  return found != json.end() && found->is_array() ? *found : kNone;
}

bool read_point(const Input& json, Eigen::Vector3d& p) {
  if (!json.is_array() || json.size() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!json[i].is_number()) return false;
    p[static_cast<Eigen::Index>(i)] = json[i].get<double>();
  }
  return true;
}

NoteItem read_item(const Input& json, const Scene& scene) {
  NoteItem item;
  item.text = text(json, "text");
  item.object = scene.find(text(json, "object"));
  if (const auto found = json.find("iteration"); found != json.end() && found->is_number_integer())
    item.iteration = found->get<int>();
  Eigen::Vector3d p;
  for (const Input& entry : list(json, "points"))
    if (read_point(entry, p)) item.points.push_back(p);
  return item;
}

NoteCells read_cells(const Input& json) {
  NoteCells cells;
  cells.cell = number(json, "cell", cells.cell);
  if (const auto origin = json.find("origin"); origin != json.end()) read_point(*origin, cells.origin);
  const Input& flat = list(json, "indices");
  for (std::size_t i = 0; i + 2 < flat.size(); i += 3) {
    if (!flat[i].is_number_integer() || !flat[i + 1].is_number_integer() || !flat[i + 2].is_number_integer()) continue;
    cells.indices.push_back({flat[i].get<int>(), flat[i + 1].get<int>(), flat[i + 2].get<int>()});
  }
  for (const Input& value : list(json, "values"))
    if (value.is_number()) cells.values.push_back(value.get<double>());
  if (cells.values.size() != cells.indices.size()) cells.values.clear();
  return cells;
}

}  // namespace

Json notes_to_json(const PlanningNotes& notes, const Scene& scene) {
  Json out{{"layers", Json::array()}};
  for (const NoteLayer& layer : notes.layers) {
    Json entry{{"name", layer.name}, {"about", layer.about}, {"items", Json::array()}};
    for (const NoteItem& item : layer.items) entry["items"].push_back(item_object(item, scene));
    if (!layer.cells.indices.empty()) entry["cells"] = cells_object(layer.cells);
    out["layers"].push_back(std::move(entry));
  }
  return out;
}

PlanningNotes notes_from_json(const Input& json, const Scene& scene) {
  PlanningNotes notes;
  if (!json.is_object()) return notes;
  for (const Input& entry : list(json, "layers")) {
    if (!entry.is_object() || text(entry, "name").empty()) continue;
    NoteLayer layer;
    layer.name = text(entry, "name");
    layer.about = text(entry, "about");
    for (const Input& item : list(entry, "items"))
      if (item.is_object()) layer.items.push_back(read_item(item, scene));
    if (const auto cells = entry.find("cells"); cells != entry.end() && cells->is_object())
      layer.cells = read_cells(*cells);
    notes.layers.push_back(std::move(layer));
  }
  return notes;
}

}  // namespace mamo::io
