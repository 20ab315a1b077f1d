#include "view/top_scene.hpp"

#include <algorithm>
#include <cmath>

#include "view/outline.hpp"

namespace mamo::view {
namespace {

constexpr double kMoved = 0.005;         // m: an object that went further is drawn as moved
constexpr double kTurned = 0.05;         // rad: or turned further
constexpr double kMarginM = 0.06;        // around what is drawn
constexpr double kLargestFixture = 3.0;  // m: a floor does not decide the scale

}  // namespace

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

TopScene::TopScene(const Problem& shown, const Plan* its_plan, const TopViewOptions& how)
    : problem(shown), plan(its_plan), options(how), kinematics(shown.robot) {
  if (const ReachPose* reach = std::get_if<ReachPose>(&problem.task)) target = reach->target;
  if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) target = retrieve->object;
  if (plan) paths = segment_paths(problem, *plan), final_ = final_poses(problem, *plan);
  collect_objects();
  collect_tip_path();
  fit();
}

Eigen::Isometry3d TopScene::pose_of(ObjectId id) const {
  const auto it = final_.find(id);
  return it == final_.end() ? problem.scene[id].X_WO : it->second;
}

void TopScene::collect_objects() {
  for (std::size_t i = 0; i < problem.scene.size(); ++i) {
    const ObjectId id(i);
    const Object& object = problem.scene[id];
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
    d.css = id == target ? "target" : moved ? "moved" : object.movable() ? "movable" : "immovable";
    drawn.push_back(std::move(d));
  }
}

Eigen::Vector2d TopScene::tip_at(const Eigen::VectorXd& q) const {
  return kinematics.tip_pose(q).translation().head<2>();
}

void TopScene::collect_tip_path() {
  for (const SegmentPath& path : paths) {
    Points2 points;
    for (std::size_t k = 0; k < path.q.size(); ++k) {
      const Eigen::VectorXd& from = path.q[k > 0 ? k - 1 : 0];
      const Eigen::VectorXd step = path.q[k] - from;
      // Straight in joints is curved in the plane: a point at least every 0.05 rad.
      const int pieces = std::max(1, static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / 0.05)));
      for (int i = k > 0 ? 1 : pieces; i <= pieces; ++i)
        points.push_back(tip_at(from + step * (static_cast<double>(i) / pieces)));
    }
    tip.emplace_back(path.kind, std::move(points));
  }
}

std::vector<Points2> TopScene::arm_outlines(const Eigen::VectorXd& q, bool moving) const {
  std::vector<Eigen::Isometry3d> X_WL;
  kinematics.link_poses(q, X_WL);
  const std::vector<bool> moves = problem.robot.moving_links();
  std::vector<Points2> outlines;
  for (std::size_t l = 0; l < X_WL.size(); ++l)
    if (moves[l] == moving)
      for (const PlacedShape& s : problem.robot.model->links[l].collision)
        outlines.push_back(outline(s.shape, X_WL[l] * s.X_BS));
  return outlines;
}

/// Chooses the scale so that everything of interest fits the width, less the legend.
void TopScene::fit() {
  Eigen::AlignedBox2d world;
  const auto extend = [&](const Points2& points) {
    for (const Eigen::Vector2d& p : points)
      if (p.allFinite()) world.extend(p);
  };
  for (const Drawn& d : drawn) {
    extend(d.outline);
    if (d.before) extend(*d.before);
  }
  for (const Object& object : problem.scene.objects) {
    if (!object.fixture()) continue;
    for (const PlacedShape& s : object.shapes) {
      const Points2 shape = outline(s.shape, object.X_WO * s.X_BS);
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& p : shape) box.extend(p);
      if (box.sizes().maxCoeff() <= kLargestFixture) extend(shape);
    }
  }
  for (const bool moving : {false, true})
    for (const Points2& link : arm_outlines(problem.q_start, moving)) extend(link);
  if (!paths.empty())
    for (const Points2& link : arm_outlines(paths.back().q.back(), true)) extend(link);
  for (const auto& [kind, points] : tip) extend(points);
  world.extend(problem.robot.X_WB.translation().head<2>().eval());
  world.min().array() -= kMarginM;
  world.max().array() += kMarginM;
  const double width = options.width_px - kLegendPx - 12;
  scale = std::min(width / world.sizes().x(), width * 1.15 / world.sizes().y());
  field = Eigen::AlignedBox2d(Eigen::Vector2d(12, kHeadPx),
                              Eigen::Vector2d(12 + width, kHeadPx + std::max(scale * world.sizes().y(), 340.0)));
  size = {options.width_px, field.max().y() + 14};
  middle = world.center();
}

Eigen::Vector2d TopScene::px_of(const Eigen::Vector2d& p) const {
  return field.center() + scale * Eigen::Vector2d(p.x() - middle.x(), middle.y() - p.y());
}
Points2 TopScene::px_of(const Points2& points) const {
  Points2 out;
  for (const Eigen::Vector2d& p : points) out.push_back(px_of(p));
  return out;
}

bool TopScene::has(const std::string& css) const {
  return std::any_of(drawn.begin(), drawn.end(), [&](const Drawn& d) { return d.css == css; });
}

bool TopScene::anything_moved() const {
  return std::any_of(drawn.begin(), drawn.end(), [](const Drawn& d) { return d.before.has_value(); });
}

}  // namespace mamo::view
