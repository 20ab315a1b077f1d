#include "view/surfaces.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "view/layers.hpp"
#include "view/palette.hpp"
#include "view/triangles.hpp"

namespace mamo::view {
namespace {

constexpr int kSides = 72;           // of round shapes
constexpr double kTube = 0.0035;     // m, radius of a path
constexpr double kFailure = 0.05;    // m, radius of the ring where a plan failed
constexpr float kWall = 0.08f;       // opacity of what is seen through
constexpr double kFloorReach = 3.2;  // m

class Collector {
 public:
  Collector(const Stage& stage, const ImageOptions& options) : stage_(stage), options_(options) {}

  std::vector<Surface> collect() {
    floor();
    robot();
    for (const StageObject& object : stage_.objects()) add_object(object);
    if (const auto X = stage_.goal()) goal(*X);
    if (options_.paths && stage_.playback().recording) paths();
    failure();
    return std::move(out_);
  }

 private:
  Eigen::Vector3f colour(std::string_view name) const {
    const Colour& entry = colour_of(name);
    return linear_colour(options_.dark ? entry.dark : entry.light);
  }

  void add(const TriangleMesh& mesh, const Eigen::Isometry3d& X, const Surface& like) {
    std::vector<Eigen::Vector3d> p;
    for (const Eigen::Vector3d& v : mesh.vertices) p.push_back(X * v);
    for (const auto& [a, b, c] : mesh.triangles) {
      Surface surface = like;
      surface.p = {p[static_cast<std::size_t>(a)], p[static_cast<std::size_t>(b)], p[static_cast<std::size_t>(c)]};
      out_.push_back(surface);
    }
  }

  Surface style(const Eigen::Vector3f& rgb, float alpha = 1, Finish finish = Finish::lit) {
    Surface surface;
    surface.colour = rgb;
    surface.alpha = alpha;
    surface.finish = finish;
    surface.body = ++body_;
    return surface;
  }

  void floor() {
    const Eigen::Vector3d c = stage_.camera().target;
    const TriangleMesh quad{{{-kFloorReach, -kFloorReach, 0},
                             {kFloorReach, -kFloorReach, 0},
                             {kFloorReach, kFloorReach, 0},
                             {-kFloorReach, kFloorReach, 0}},
                            {{0, 1, 2}, {0, 2, 3}}};
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = Eigen::Vector3d(c.x(), c.y(), -0.002);
    add(quad, X, style(linear_colour(options_.dark ? "#2a323a" : "#e3e8ee"), 1, Finish::floor));
    for (Surface& surface : out_) surface.body = 0;  // no line where it meets the sky
  }

  void robot() {
    const Robot& robot = stage_.problem().robot;
    const std::vector<bool> moving = robot.moving_links();
    const VisualMeshes visuals(*robot.model, kVisualBudget);
    std::vector<Eigen::Isometry3d> X_WL;
    stage_.kinematics().link_poses(stage_.q_at(options_.time_s), X_WL);
    for (std::size_t l = 0; l < X_WL.size(); ++l) {
      const Link& link = robot.model->links[l];
      bool seen = false;
      for (const VisualGeometry& visual : link.visual) {
        const TriangleMesh* mesh = visual.shape ? nullptr : visuals.find(visual);
        if (!visual.shape && !mesh) continue;
        seen = true;
        const Eigen::Vector3d rgb = visual.rgba.head<3>().array().pow(2.2);
        add(mesh ? *mesh : tessellate(*visual.shape, kSides), X_WL[l] * visual.X_LV, style(rgb.cast<float>()));
      }
      if (seen) continue;
      const Surface like = style(colour(moving[l] ? "arm" : "body"));
      for (const PlacedShape& s : link.collision) add(tessellate(s.shape, kSides), X_WL[l] * s.X_BS, like);
    }
  }

  void add_object(const StageObject& shown) {
    const Surface like = style(colour(shown.role), shown.see_through ? kWall : 1);
    const Eigen::Isometry3d X = stage_.X_WO_at(shown.id, options_.time_s);
    for (const PlacedShape& s : stage_.problem().scene[shown.id].shapes)
      add(tessellate(s.shape, kSides), X * s.X_BS, like);
  }

  void tube(const std::vector<Eigen::Vector3d>& points, const Surface& like, double radius = kTube) {
    constexpr int kCorners = 8;
    TriangleMesh mesh;
    Eigen::Vector3d side = Eigen::Vector3d::UnitZ();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Eigen::Vector3d along =
          (points[std::min(k + 1, points.size() - 1)] - points[k > 0 ? k - 1 : 0]).normalized();
      if (along.cross(side).norm() < 0.1) side = along.unitOrthogonal();
      side = (side - along * along.dot(side)).normalized();
      const Eigen::Vector3d other = along.cross(side);
      for (int c = 0; c < kCorners; ++c) {
        const double a = 2 * std::numbers::pi * c / kCorners;
        mesh.vertices.push_back(points[k] + radius * (std::cos(a) * side + std::sin(a) * other));
      }
      if (k == 0) continue;
      const int base = static_cast<int>(k - 1) * kCorners;
      for (int c = 0; c < kCorners; ++c) {
        const int d = (c + 1) % kCorners;
        mesh.triangles.push_back({base + c, base + d, base + kCorners + c});
        mesh.triangles.push_back({base + d, base + kCorners + d, base + kCorners + c});
      }
    }
    add(mesh, Eigen::Isometry3d::Identity(), like);
  }

  void ring(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius, const Surface& like) {
    std::vector<Eigen::Vector3d> points;
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    for (int k = 0; k <= 48; ++k) {
      const double a = 2 * std::numbers::pi * k / 48;
      points.push_back(centre + radius * (std::cos(a) * u + std::sin(a) * v));
    }
    tube(points, like);
  }

  void goal(const Eigen::Isometry3d& X) {
    const Surface like = style(colour("goal"), 1, Finish::plain);
    const Eigen::Vector3d forward = X.linear().col(0);
    tube({X.translation() - 0.115 * forward, X.translation()}, like);
    ring(X.translation(), forward, 0.022, like);
  }

  void paths() {
    for (const NoteItem& item : tip_path(stage_).items) tube(item.points, style(colour(item.text), 1, Finish::plain));
    const Surface like = style(colour("moved"), 1, Finish::plain);
    for (const NoteItem& item : object_paths(stage_).items) tube(item.points, like);
  }

  void failure() {
    const Verdict* verdict = stage_.playback().verdict;
    if (!verdict || verdict->findings.empty()) return;
    const Violation& violation = verdict->findings.front().violation;
    const auto place = stage_.place_of(violation);
    if (!place || options_.time_s < violation.time_s - 1) return;
    const Camera camera = stage_.camera();
    const double yaw = camera.yaw + options_.yaw_deg * std::numbers::pi / 180;
    const Surface like = style(colour("contact"), 1, Finish::plain);
    ring(*place, Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.7).normalized(), kFailure, like);
  }

  const Stage& stage_;
  const ImageOptions& options_;
  std::vector<Surface> out_;
  int body_ = 0;
};

}  // namespace

Eigen::Vector3f linear_colour(std::string_view hex) {
  Eigen::Vector3f rgb;
  for (int i = 0; i < 3; ++i) {
    const std::string digits(hex.substr(1 + 2 * static_cast<std::size_t>(i), 2));
    rgb[i] = std::pow(static_cast<float>(std::strtol(digits.c_str(), nullptr, 16)) / 255.0f, 2.2f);
  }
  return rgb;
}

std::vector<Surface> surfaces_at(const Stage& stage, const ImageOptions& options) {
  return Collector(stage, options).collect();
}

}  // namespace mamo::view
