// The bodies of the picture from above.
#include <algorithm>
#include <cmath>
#include <limits>

#include "view/outline.hpp"
#include "view/top_scene.hpp"

namespace mamo::view {
namespace {

class Bodies {
 public:
  explicit Bodies(const TopScene& scene) : s_(scene) {}

  std::string draw() const {
    std::string body;
    grid(body);
    fixtures(body, false);
    robot(body);
    for (const TopScene::Drawn& d : s_.drawn)
      if (d.before) shapes(body, "was", d.id, s_.problem.scene[d.id].X_WO);
    for (const TopScene::Drawn& d : s_.drawn) shapes(body, d.css, d.id, s_.pose_of(d.id));
    fixtures(body, true);
    for (const TopScene::Drawn& d : s_.drawn)
      if (d.before) arrow(body, s_.px_of(d.from), s_.px_of(d.to));
    tip_path(body);
    goal(body);
    return body;
  }

 private:
  void grid(std::string& out) const {
    const Eigen::Vector2d half = s_.field.sizes() / s_.scale / 2;
    const double step = 0.1;
    std::string lines;
    for (double x = std::ceil((s_.middle.x() - half.x()) / step) * step; x <= s_.middle.x() + half.x(); x += step)
      lines += path_data(s_.px_of(Points2{{x, s_.middle.y() - half.y()}, {x, s_.middle.y() + half.y()}}), false);
    for (double y = std::ceil((s_.middle.y() - half.y()) / step) * step; y <= s_.middle.y() + half.y(); y += step)
      lines += path_data(s_.px_of(Points2{{s_.middle.x() - half.x(), y}, {s_.middle.x() + half.x(), y}}), false);
    out += "<path class=\"grid\" d=\"" + lines + "\"/>\n";
  }

  void shapes(std::string& out, const std::string& css, ObjectId id, const Eigen::Isometry3d& X_WO) const {
    const Object& object = s_.problem.scene[id];
    for (const PlacedShape& s : object.shapes)
      out += path_element(css, s_.px_of(outline(s.shape, X_WO * s.X_BS)), true, object.id);
  }

  /// A fixture that begins above the objects' centres hides nothing: an outline.
  bool roof(const Object& fixture) const {
    if (s_.drawn.empty()) return false;
    double highest = -std::numeric_limits<double>::infinity();
    for (const TopScene::Drawn& d : s_.drawn)
      highest = std::max(highest, s_.problem.scene[d.id].X_WO.translation().z());
    double bottom = std::numeric_limits<double>::infinity();
    for (const PlacedShape& s : fixture.shapes)
      bottom = std::min(bottom, bounds(s.shape, fixture.X_WO * s.X_BS).min().z());
    return bottom > highest;
  }

  void fixtures(std::string& out, bool roofs) const {
    std::vector<std::pair<double, ObjectId>> order;  // lowest first
    for (std::size_t i = 0; i < s_.problem.scene.size(); ++i) {
      const Object& object = s_.problem.scene.objects[i];
      if (object.fixture() && roof(object) == roofs) order.emplace_back(object.X_WO.translation().z(), ObjectId(i));
    }
    std::sort(order.begin(), order.end());
    for (const auto& [z, id] : order) shapes(out, roofs ? "roof" : "fixture", id, s_.problem.scene[id].X_WO);
  }

  void robot(std::string& out) const {
    const auto draw = [&](const char* css, const std::vector<Points2>& outlines, const char* tooltip) {
      for (const Points2& points : outlines) out += path_element(css, s_.px_of(points), true, tooltip);
    };
    draw("body", s_.arm_outlines(s_.problem.q_start, false), "the robot's still links");
    draw("arm0", s_.arm_outlines(s_.problem.q_start, true), "the arm at the start");
    if (!s_.paths.empty()) draw("arm1", s_.arm_outlines(s_.paths.back().q.back(), true), "the arm at the end");
    const Eigen::Vector2d base = s_.px_of(Eigen::Vector2d(s_.problem.robot.X_WB.translation().head<2>()));
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
    for (const auto& [kind, points] : s_.tip) out += path_element("halo", s_.px_of(points), false);
    for (const auto& [kind, points] : s_.tip)
      out += path_element("tip " + std::string(to_string(kind)), s_.px_of(points), false, std::string(to_string(kind)));
    const Eigen::Vector2d start = s_.px_of(s_.tip_at(s_.problem.q_start));
    out += "<circle class=\"dot\" cx=\"" + px(start.x()) + "\" cy=\"" + px(start.y()) + "\" r=\"4\"/>\n";
  }

  /// Where the tip shall go: a cross in a ring, with a tick along the tip's x axis.
  void goal(std::string& out) const {
    Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
    if (const auto* reach = std::get_if<ReachPose>(&s_.problem.task)) X_WT = reach->X_WT;
    if (const auto* retrieve = std::get_if<Retrieve>(&s_.problem.task)) X_WT = retrieve->X_WT_pregrasp;
    if (const auto* joints = std::get_if<ReachJoints>(&s_.problem.task)) X_WT = s_.kinematics.tip_pose(joints->q);
    const Eigen::Vector2d c = s_.px_of(Eigen::Vector2d(X_WT.translation().head<2>()));
    out += goal_mark(c);
    const Eigen::Vector2d x = X_WT.linear().col(0).head<2>();
    if (x.norm() > 0.1) {
      const Eigen::Vector2d d(x.x(), -x.y());
      out += path_element("goal", {c + d * 7, c + d * 20}, false);
    }
  }

  const TopScene& s_;
};

}  // namespace

std::string goal_mark(const Eigen::Vector2d& c) {
  std::string out;
  out +=
      "<circle class=\"goal\" cx=\"" + px(c.x()) + "\" cy=\"" + px(c.y()) + "\" r=\"7\"><title>goal</title></circle>\n";
  out += path_element("goal", {c + Eigen::Vector2d(-3, -3), c + Eigen::Vector2d(3, 3)}, false);
  out += path_element("goal", {c + Eigen::Vector2d(-3, 3), c + Eigen::Vector2d(3, -3)}, false);
  return out;
}

std::string draw_bodies(const TopScene& scene) { return Bodies(scene).draw(); }

}  // namespace mamo::view
