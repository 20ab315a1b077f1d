#include "mamo/view/top_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "view/label_placer.hpp"
#include "view/outline.hpp"
#include "view/plan_path.hpp"
#include "mamo/view/svg.hpp"
#include "view/top_view_style.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"

namespace mamo::view {
namespace {

constexpr double kMoved = 0.005;         // m: an object that went further is drawn as moved
constexpr double kTurned = 0.05;         // rad: or turned further
constexpr double kLegendPx = 210;        // width of the legend
constexpr double kHeadPx = 58;           // height of the title
constexpr double kMarginM = 0.06;        // around what is drawn
constexpr double kLargestFixture = 3.0;  // m: a floor does not decide the scale

struct Drawn {  // an object, with everything the picture needs of it
  ObjectId id;
  std::string css;
  Points2 outline;                // world, where it ends (or is)
  std::optional<Points2> before;  // world, if it moved
  Eigen::Vector2d from, to;       // centres, world
};

Points2 body_outline(const Object& object, const Eigen::Isometry3d& X_WO) {
  Points2 points;  // the largest shape's outline stands for the label; several shapes are drawn one by one
  double area = -1;
  for (const PlacedShape& s : object.shapes) {
    const Points2 shape = outline(s.shape, X_WO * s.X_BS);
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : shape) box.extend(p);
    if (box.volume() > area) area = box.volume(), points = shape;
  }
  return points;
}

class TopView {
 public:
  TopView(const Problem& problem, const Plan* plan, const TopViewOptions& options)
      : problem_(problem), plan_(plan), options_(options), kinematics_(problem.robot) {
    if (const ReachPose* reach = std::get_if<ReachPose>(&problem.task)) target_ = reach->target;
    if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) target_ = retrieve->object;
    if (plan_) paths_ = segment_paths(problem, *plan_), final_ = final_poses(problem, *plan_);
    collect_objects();
    collect_tip_path();
    fit();
  }

  std::string svg() {
    const double height = size_.y();
    std::string body;
    grid(body);
    fixtures(body, false);
    robot(body);
    for (const Drawn& d : drawn_)
      if (d.before) shapes(body, "was", d.id, problem_.scene[d.id].X_WO);
    for (const Drawn& d : drawn_) shapes(body, d.css, d.id, pose_of(d.id));
    fixtures(body, true);
    for (const Drawn& d : drawn_)
      if (d.before) arrow(body, px_of(d.from), px_of(d.to));
    tip_path(body);
    goal(body);
    labels(body);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + px(options_.width_px) + "\" height=\"" +
                      px(height) + "\" viewBox=\"0 0 " + px(options_.width_px) + " " + px(height) + "\">\n<style>" +
                      kTopViewStyle + "</style>\n";
    out += "<rect class=\"bg\" width=\"100%\" height=\"100%\"/>\n";
    out += "<clipPath id=\"field\"><rect x=\"" + px(field_.min().x()) + "\" y=\"" + px(field_.min().y()) +
           "\" width=\"" + px(field_.sizes().x()) + "\" height=\"" + px(field_.sizes().y()) + "\"/></clipPath>\n";
    out += "<g clip-path=\"url(#field)\">\n" + body + "</g>\n";
    head(out);
    legend(out);
    return out + "</svg>\n";
  }

 private:
  Eigen::Isometry3d pose_of(ObjectId id) const {
    const auto it = final_.find(id);
    return it == final_.end() ? problem_.scene[id].X_WO : it->second;
  }

  void collect_objects() {
    for (std::size_t i = 0; i < problem_.scene.size(); ++i) {
      const ObjectId id(i);
      const Object& object = problem_.scene[id];
      if (object.fixture()) continue;
      const Eigen::Isometry3d X = pose_of(id);
      Drawn d;
      d.id = id;
      d.outline = body_outline(object, X);
      d.from = (object.X_WO * object.centre_of_mass()).head<2>();
      d.to = (X * object.centre_of_mass()).head<2>();
      const double turned = Eigen::AngleAxisd(object.X_WO.linear().transpose() * X.linear()).angle();
      const bool moved = (X.translation() - object.X_WO.translation()).norm() > kMoved || turned > kTurned;
      if (moved) d.before = body_outline(object, object.X_WO);
      d.css = id == target_ ? "target" : moved ? "moved" : object.movable() ? "movable" : "immovable";
      drawn_.push_back(std::move(d));
    }
  }

  Eigen::Vector2d tip_at(const Eigen::VectorXd& q) const { return kinematics_.tip_pose(q).translation().head<2>(); }

  void collect_tip_path() {
    for (const SegmentPath& path : paths_) {
      Points2 points;
      for (std::size_t k = 0; k < path.q.size(); ++k) {
        const Eigen::VectorXd& from = path.q[k > 0 ? k - 1 : 0];
        const Eigen::VectorXd step = path.q[k] - from;
        // Straight in joints is curved in the plane: a point at least every 0.05 rad.
        const int pieces = std::max(1, static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / 0.05)));
        for (int i = k > 0 ? 1 : pieces; i <= pieces; ++i)
          points.push_back(tip_at(from + step * (static_cast<double>(i) / pieces)));
      }
      tip_.emplace_back(path.kind, std::move(points));
    }
  }

  std::vector<Points2> arm_outlines(const Eigen::VectorXd& q, bool moving) const {
    std::vector<Eigen::Isometry3d> X_WL;
    kinematics_.link_poses(q, X_WL);
    const std::vector<bool> moves = problem_.robot.moving_links();
    std::vector<Points2> outlines;
    for (std::size_t l = 0; l < X_WL.size(); ++l)
      if (moves[l] == moving)
        for (const PlacedShape& s : problem_.robot.model->links[l].collision)
          outlines.push_back(outline(s.shape, X_WL[l] * s.X_BS));
    return outlines;
  }

  /// Chooses the scale so that everything of interest fits the width, less the legend.
  void fit() {
    Eigen::AlignedBox2d world;
    const auto extend = [&](const Points2& points) {
      for (const Eigen::Vector2d& p : points)
        if (p.allFinite()) world.extend(p);
    };
    for (const Drawn& d : drawn_) {
      extend(d.outline);
      if (d.before) extend(*d.before);
    }
    for (const Object& object : problem_.scene.objects) {
      if (!object.fixture()) continue;
      for (const PlacedShape& s : object.shapes) {
        const Points2 shape = outline(s.shape, object.X_WO * s.X_BS);
        Eigen::AlignedBox2d box;
        for (const Eigen::Vector2d& p : shape) box.extend(p);
        if (box.sizes().maxCoeff() <= kLargestFixture) extend(shape);
      }
    }
    for (const bool moving : {false, true})
      for (const Points2& link : arm_outlines(problem_.q_start, moving)) extend(link);
    if (!paths_.empty())
      for (const Points2& link : arm_outlines(paths_.back().q.back(), true)) extend(link);
    for (const auto& [kind, points] : tip_) extend(points);
    world.extend(problem_.robot.X_WB.translation().head<2>().eval());
    world.min().array() -= kMarginM;
    world.max().array() += kMarginM;
    const double width = options_.width_px - kLegendPx - 12;
    scale_ = std::min(width / world.sizes().x(), width * 1.15 / world.sizes().y());
    field_ = Eigen::AlignedBox2d(Eigen::Vector2d(12, kHeadPx),
                                 Eigen::Vector2d(12 + width, kHeadPx + std::max(scale_ * world.sizes().y(), 340.0)));
    size_ = {options_.width_px, field_.max().y() + 14};
    middle_ = world.center();
  }

  Eigen::Vector2d px_of(const Eigen::Vector2d& p) const {
    return field_.center() + scale_ * Eigen::Vector2d(p.x() - middle_.x(), middle_.y() - p.y());
  }
  Points2 px_of(const Points2& points) const {
    Points2 out;
    for (const Eigen::Vector2d& p : points) out.push_back(px_of(p));
    return out;
  }

  void grid(std::string& out) const {
    const Eigen::Vector2d half = field_.sizes() / scale_ / 2;
    const double step = 0.1;
    std::string lines;
    for (double x = std::ceil((middle_.x() - half.x()) / step) * step; x <= middle_.x() + half.x(); x += step)
      lines += path_data(px_of(Points2{{x, middle_.y() - half.y()}, {x, middle_.y() + half.y()}}), false);
    for (double y = std::ceil((middle_.y() - half.y()) / step) * step; y <= middle_.y() + half.y(); y += step)
      lines += path_data(px_of(Points2{{middle_.x() - half.x(), y}, {middle_.x() + half.x(), y}}), false);
    out += "<path class=\"grid\" d=\"" + lines + "\"/>\n";
  }

  void shapes(std::string& out, const std::string& css, ObjectId id, const Eigen::Isometry3d& X_WO) const {
    const Object& object = problem_.scene[id];
    for (const PlacedShape& s : object.shapes)
      out += path_element(css, px_of(outline(s.shape, X_WO * s.X_BS)), true, object.id);
  }

  /// A fixture that begins above the objects' centres hides nothing: an outline.
  bool roof(const Object& fixture) const {
    if (drawn_.empty()) return false;
    double highest = -std::numeric_limits<double>::infinity();
    for (const Drawn& d : drawn_) highest = std::max(highest, problem_.scene[d.id].X_WO.translation().z());
    double bottom = std::numeric_limits<double>::infinity();
    for (const PlacedShape& s : fixture.shapes)
      bottom = std::min(bottom, bounds(s.shape, fixture.X_WO * s.X_BS).min().z());
    return bottom > highest;
  }

  void fixtures(std::string& out, bool roofs) const {
    std::vector<std::pair<double, ObjectId>> order;  // lowest first
    for (std::size_t i = 0; i < problem_.scene.size(); ++i) {
      const Object& object = problem_.scene.objects[i];
      if (object.fixture() && roof(object) == roofs) order.emplace_back(object.X_WO.translation().z(), ObjectId(i));
    }
    std::sort(order.begin(), order.end());
    for (const auto& [z, id] : order) shapes(out, roofs ? "roof" : "fixture", id, problem_.scene[id].X_WO);
  }

  void robot(std::string& out) const {
    const auto draw = [&](const char* css, const std::vector<Points2>& outlines, const char* tooltip) {
      for (const Points2& points : outlines) out += path_element(css, px_of(points), true, tooltip);
    };
    draw("body", arm_outlines(problem_.q_start, false), "the robot's still links");
    draw("arm0", arm_outlines(problem_.q_start, true), "the arm at the start");
    if (!paths_.empty()) draw("arm1", arm_outlines(paths_.back().q.back(), true), "the arm at the end");
    const Eigen::Vector2d base = px_of(Eigen::Vector2d(problem_.robot.X_WB.translation().head<2>()));
    out += path_element("bar", {base + Eigen::Vector2d(-6, 0), base + Eigen::Vector2d(6, 0)}, false);
    out += path_element("bar", {base + Eigen::Vector2d(0, -6), base + Eigen::Vector2d(0, 6)}, false);
  }

  void arrow(std::string& out, const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    const double length = (to - from).norm();
    if (length < 6) return;
    const Eigen::Vector2d d = (to - from) / length, n(-d.y(), d.x());
    const double head = std::min(9.0, length * 0.6);
    out += path_element("arrow", {from, to - d * head * 0.7}, false);
    out += path_element("head", {to, to - d * head + n * head * 0.42, to - d * head - n * head * 0.42}, true);
  }

  void tip_path(std::string& out) const {
    for (const auto& [kind, points] : tip_) out += path_element("halo", px_of(points), false);
    for (const auto& [kind, points] : tip_)
      out += path_element("tip " + std::string(to_string(kind)), px_of(points), false, std::string(to_string(kind)));
    const Eigen::Vector2d start = px_of(tip_at(problem_.q_start));
    out += "<circle class=\"dot\" cx=\"" + px(start.x()) + "\" cy=\"" + px(start.y()) + "\" r=\"4\"/>\n";
  }

  /// Where the tip shall go: a cross in a ring, with a tick along the tip's x axis.
  void goal(std::string& out) const {
    Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
    if (const auto* reach = std::get_if<ReachPose>(&problem_.task)) X_WT = reach->X_WT;
    if (const auto* retrieve = std::get_if<Retrieve>(&problem_.task)) X_WT = retrieve->X_WT_pregrasp;
    if (const auto* joints = std::get_if<ReachJoints>(&problem_.task)) X_WT = kinematics_.tip_pose(joints->q);
    const Eigen::Vector2d c = px_of(Eigen::Vector2d(X_WT.translation().head<2>()));
    goal_mark(out, c);
    const Eigen::Vector2d x = X_WT.linear().col(0).head<2>();
    if (x.norm() > 0.1) {
      const Eigen::Vector2d d(x.x(), -x.y());
      out += path_element("goal", {c + d * 7, c + d * 20}, false);
    }
  }

  static void goal_mark(std::string& out, const Eigen::Vector2d& c) {
    out += "<circle class=\"goal\" cx=\"" + px(c.x()) + "\" cy=\"" + px(c.y()) +
           "\" r=\"7\"><title>goal</title></circle>\n";
    out += path_element("goal", {c + Eigen::Vector2d(-3, -3), c + Eigen::Vector2d(3, 3)}, false);
    out += path_element("goal", {c + Eigen::Vector2d(-3, 3), c + Eigen::Vector2d(3, -3)}, false);
  }

  void labels(std::string& out) const {
    LabelPlacer placer(field_);
    for (const Drawn& d : drawn_) {
      double radius = 0;
      for (const Eigen::Vector2d& p : d.outline) radius = std::max(radius, (p - d.to).norm());
      label(out, placer, "label", problem_.scene[d.id].id, px_of(d.to), radius * scale_, 11);
    }
    for (const Object& object : problem_.scene.objects) {
      if (!object.fixture()) continue;
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& p : px_of(body_outline(object, object.X_WO))) box.extend(p);
      box = box.intersection(field_);
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
    if (std::holds_alternative<ReachJoints>(problem_.task)) task = "reach a configuration";
    if (std::holds_alternative<Retrieve>(problem_.task)) task = "retrieve";
    if (target_ != kNoObject) task += (task == "retrieve" ? " " : " at ") + problem_.scene[target_].id;
    std::size_t movable = 0, immovable = 0, moved = 0;
    for (const Drawn& d : drawn_) {
      ++(problem_.scene[d.id].movable() ? movable : immovable);
      moved += d.before.has_value();
    }
    std::string line = problem_.robot.model->name + "  ·  " + task + "  ·  " + std::to_string(movable) + " movable, " +
                       std::to_string(immovable) + " immovable  ·  " + std::string(to_string(problem_.profile));
    if (plan_) line += "  ·  " + std::to_string(moved) + " moved";
    const std::string title = options_.title.empty() ? problem_.name : options_.title;
    out += "<title>" + escaped(title) + "</title>\n";
    out += text_element("title", {14, 26}, title);
    out += text_element("sub", {14, 45}, line);
  }

  void legend(std::string& out) const {
    const double x = options_.width_px - kLegendPx + 14;
    double y = field_.min().y() + 12;
    const auto row = [&](const std::string& text) {
      out += text_element("key", {x + 34, y + 4}, text);
      y += 22;
    };
    const auto swatch = [&](const std::string& css, const std::string& text) {
      out += path_element(css, {{x, y - 6}, {x + 24, y - 6}, {x + 24, y + 6}, {x, y + 6}}, true);
      row(text);
    };
    const auto has = [&](const std::string& css) {
      return std::any_of(drawn_.begin(), drawn_.end(), [&](const Drawn& d) { return d.css == css; });
    };
    if (has("target")) swatch("target", "target");
    if (has("immovable")) swatch("immovable", "immovable");
    if (has("movable")) swatch("movable", "movable");
    if (has("moved")) swatch("moved", "moved by the plan");
    if (std::any_of(drawn_.begin(), drawn_.end(), [](const Drawn& d) { return d.before.has_value(); })) {
      swatch("was", "where it was");
    }
    swatch("fixture", "fixture");
    swatch("arm0", "arm at the start");
    if (!paths_.empty()) swatch("arm1", "arm at the end");
    goal_mark(out, {x + 12, y});
    row("goal of the tip");
    std::set<SegmentKind> seen;
    for (const auto& [kind, points] : tip_) {
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
      if (candidate * scale_ <= kLegendPx - 60) length = candidate;
    const double w = length * scale_;
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

  const Problem& problem_;
  const Plan* plan_;
  const TopViewOptions& options_;
  ForwardKinematics kinematics_;
  ObjectId target_ = kNoObject;
  std::vector<SegmentPath> paths_;
  std::map<ObjectId, Eigen::Isometry3d> final_;
  std::vector<Drawn> drawn_;
  std::vector<std::pair<SegmentKind, Points2>> tip_;
  double scale_ = 1;           // px per m
  Eigen::AlignedBox2d field_;  // px, where the world is drawn
  Eigen::Vector2d middle_{0, 0}, size_{0, 0};
};

}  // namespace

std::string top_view_svg(const Problem& problem, const Plan* plan, const TopViewOptions& options) {
  return TopView(problem, plan, options).svg();
}

}  // namespace mamo::view
