// Title, legend, scale and names of the picture from above.
#include <algorithm>
#include <set>

#include "view/label_placer.hpp"
#include "view/top_scene.hpp"

namespace mamo::view {
namespace {

class Frame {
 public:
  explicit Frame(const TopScene& scene) : s_(scene) {}

  void labels(std::string& out) const {
    LabelPlacer placer(s_.field);
    for (const TopScene::Drawn& d : s_.drawn) {
      double radius = 0;
      for (const Eigen::Vector2d& p : d.outline) radius = std::max(radius, (p - d.to).norm());
      label(out, placer, "label", s_.problem.scene[d.id].id, s_.px_of(d.to), radius * s_.scale, 11);
    }
    for (const Object& object : s_.problem.scene.objects) {
      if (!object.fixture()) continue;
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& p : s_.px_of(body_outline(object, object.X_WO))) box.extend(p);
      box = box.intersection(s_.field);
      if (box.isEmpty()) continue;
      // In the upper left corner of a wide fixture, in the middle of a thin one.
      const Eigen::Vector2d size = text_size(object.id, 10);
      const Eigen::Vector2d anchor = box.sizes().minCoeff() > 60
                                         ? Eigen::Vector2d(box.min() + size / 2 + Eigen::Vector2d(6, 4))
                                         : Eigen::Vector2d(box.center());
      label(out, placer, "place", object.id, anchor, size.x(), 10);
    }
  }

  static void label(std::string& out, LabelPlacer& placer, const std::string& css, const std::string& text,
                    const Eigen::Vector2d& anchor, double radius_px, double font_px) {
    const std::optional<LabelPlace> place = placer.place(anchor, radius_px, text_size(text, font_px));
    if (!place) return;
    if (place->far) out += path_element("leader", {anchor, place->centre}, false);
    out += text_element(css, place->centre + Eigen::Vector2d(0, font_px * 0.35), text, "middle");
  }

  void head(std::string& out) const {
    std::string task = "reach a pose";
    if (std::holds_alternative<ReachJoints>(s_.problem.task)) task = "reach a configuration";
    if (std::holds_alternative<Retrieve>(s_.problem.task)) task = "retrieve";
    if (s_.target != kNoObject) task += (task == "retrieve" ? " " : " at ") + s_.problem.scene[s_.target].id;
    std::size_t movable = 0, immovable = 0, moved = 0;
    for (const TopScene::Drawn& d : s_.drawn) {
      ++(s_.problem.scene[d.id].movable() ? movable : immovable);
      moved += d.before.has_value();
    }
    std::string line = s_.problem.robot.model->name + "  ·  " + task + "  ·  " + std::to_string(movable) +
                       " movable, " + std::to_string(immovable) + " immovable  ·  " +
                       std::string(to_string(s_.problem.profile));
    if (s_.plan) line += "  ·  " + std::to_string(moved) + " moved";
    const std::string title = s_.options.title.empty() ? s_.problem.name : s_.options.title;
    out += "<title>" + escaped(title) + "</title>\n";
    out += text_element("title", {14, 26}, title);
    out += text_element("sub", {14, 45}, line);
  }

  void legend(std::string& out) const {
    const double x = s_.options.width_px - kLegendPx + 14;
    double y = s_.field.min().y() + 12;
    const auto row = [&](const std::string& text) {
      out += text_element("key", {x + 34, y + 4}, text);
      y += 22;
    };
    const auto swatch = [&](const std::string& css, const std::string& text) {
      out += path_element(css, {{x, y - 6}, {x + 24, y - 6}, {x + 24, y + 6}, {x, y + 6}}, true);
      row(text);
    };
    if (s_.has("target")) swatch("target", "target");
    if (s_.has("immovable")) swatch("immovable", "immovable");
    if (s_.has("movable")) swatch("movable", "movable");
    if (s_.has("moved")) swatch("moved", "moved by the plan");
    if (s_.anything_moved()) swatch("was", "where it was");
    swatch("fixture", "fixture");
    swatch("arm0", "arm at the start");
    if (!s_.paths.empty()) swatch("arm1", "arm at the end");
    out += goal_mark({x + 12, y});
    row("goal of the tip");
    std::set<SegmentKind> seen;
    for (const auto& [kind, points] : s_.tip) {
      if (!seen.insert(kind).second) continue;
      out += path_element("tip " + std::string(to_string(kind)), {{x, y}, {x + 24, y}}, false);
      row("tip: " + std::string(to_string(kind)));
    }
    y += 14;
    scale_bar(out, {x, y});
    axes(out, {x + 4, y + 74});
  }

  /// A round length that takes about a third of the legend or less.
  void scale_bar(std::string& out, const Eigen::Vector2d& at) const {
    double length = 0.01;
    for (double candidate : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
      if (candidate * s_.scale <= kLegendPx - 60) length = candidate;
    const double w = length * s_.scale;
    out += path_element("bar",
                        {at + Eigen::Vector2d(0, -5), at + Eigen::Vector2d(0, 0), at + Eigen::Vector2d(w, 0),
                         at + Eigen::Vector2d(w, -5)},
                        false);
    const std::string text = length < 1 ? px(length * 100) + " cm" : px(length) + " m";
    out += text_element("key", at + Eigen::Vector2d(w / 2, 16), text, "middle");
  }

  static void axes(std::string& out, const Eigen::Vector2d& at) {
    for (const auto& [d, name] : {std::pair(Eigen::Vector2d(1, 0), "x"), std::pair(Eigen::Vector2d(0, -1), "y")}) {
      const Eigen::Vector2d n(-d.y(), d.x()), end = at + d * 30;
      out += path_element("bar", {at, end}, false);
      out += path_element("bar", {end - d * 5 + n * 3, end, end - d * 5 - n * 3}, false);
      out += text_element("key", end + d * 8 + Eigen::Vector2d(0, 4), name, "middle");
    }
  }

  const TopScene& s_;
};

}  // namespace

std::string draw_labels(const TopScene& scene) {
  std::string out;
  Frame(scene).labels(out);
  return out;
}

std::string draw_frame(const TopScene& scene) {
  std::string out;
  Frame(scene).head(out);
  Frame(scene).legend(out);
  return out;
}

}  // namespace mamo::view
