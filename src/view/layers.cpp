#include "view/layers.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mamo::view {
namespace {

constexpr double kSweptCell = 0.03;   // m
constexpr double kSweptTurn = 0.06;   // rad: between two configurations that are looked at
constexpr double kPathStep = 0.004;   // m: between two points of a line
constexpr double kWorthALine = 0.01;  // m

/// Points of a path, fewer where it hardly moves; always the last one.
class Line {
 public:
  void add(const Eigen::Vector3d& p) {
    last_ = p;
    if (points_.empty() || (points_.back() - p).norm() >= kPathStep) points_.push_back(p);
  }
  std::vector<Eigen::Vector3d> points() const {
    std::vector<Eigen::Vector3d> out = points_;
    if (!out.empty() && out.back() != last_) out.push_back(last_);
    return out;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  Eigen::Vector3d last_{0, 0, 0};
};

/// Cells of the grid that an arm link covers in some configuration; those with all six neighbours are left out.
class Swept {
 public:
  void add(const Shape& shape, const Eigen::Isometry3d& X_WS) {
    const Eigen::AlignedBox3d box = bounds(shape, X_WS);
    const Eigen::Isometry3d X_SW = X_WS.inverse();
    const auto low = index(box.min()), high = index(box.max());
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k) {
          const Eigen::Vector3d centre = (Eigen::Vector3d(i, j, k) + Eigen::Vector3d::Constant(0.5)) * kSweptCell;
          if (signed_distance(shape, X_SW * centre) <= kSweptCell / 2) cells_.insert({i, j, k});
        }
  }

  NoteCells surface() const {
    NoteCells out;
    out.cell = kSweptCell;
    for (const auto& [i, j, k] : cells_) {
      const bool inside = cells_.contains({i - 1, j, k}) && cells_.contains({i + 1, j, k}) &&
                          cells_.contains({i, j - 1, k}) && cells_.contains({i, j + 1, k}) &&
                          cells_.contains({i, j, k - 1}) && cells_.contains({i, j, k + 1});
      if (!inside) out.indices.push_back({i, j, k});
    }
    return out;
  }

 private:
  static std::array<int, 3> index(const Eigen::Vector3d& p) {
    const auto floor = [](double v) { return static_cast<int>(std::floor(v / kSweptCell)); };
    return {floor(p.x()), floor(p.y()), floor(p.z())};
  }
  std::set<std::array<int, 3>> cells_;
};

NoteLayer swept_volume(const Stage& stage) {
  NoteLayer layer{"swept volume", "Where the arm is at some moment of the plan (3 cm cells).", {}, {}};
  const Robot& robot = stage.problem().robot;
  const std::vector<bool> moving = robot.moving_links();
  Swept swept;
  std::vector<Eigen::Isometry3d> X_WL;
  Eigen::VectorXd last;
  for (const Eigen::VectorXd& q : stage.playback().recording->q) {
    if (last.size() > 0 && (q - last).cwiseAbs().sum() < kSweptTurn) continue;
    last = q;
    stage.kinematics().link_poses(q, X_WL);
    for (std::size_t l = 0; l < X_WL.size(); ++l)
      if (moving[l])
        for (const PlacedShape& s : robot.model->links[l].collision) swept.add(s.shape, X_WL[l] * s.X_BS);
  }
  layer.cells = swept.surface();
  return layer;
}

}  // namespace

NoteLayer tip_path(const Stage& stage) {
  NoteLayer layer{"tip path", "The path of the robot's tip, coloured by the kind of segment.", {}, {}};
  const Recording& recording = *stage.playback().recording;
  for (const StageSegment& segment : stage.segments()) {
    Line line;
    for (std::size_t k = 0; k < recording.t.size(); ++k)
      if (recording.t[k] >= segment.begin_s - kRecordingStep && recording.t[k] <= segment.end_s + 1e-6)
        line.add(stage.kinematics().tip_pose(recording.q[k]).translation());
    NoteItem item;
    item.text = std::string(to_string(segment.kind));
    item.points = line.points();
    if (item.points.size() > 1) layer.items.push_back(std::move(item));
  }
  return layer;
}

NoteLayer object_paths(const Stage& stage) {
  NoteLayer layer{"object paths", "Where each object went in the replay.", {}, {}};
  for (const auto& [id, track] : stage.playback().recording->tracks) {
    const Eigen::Vector3d centre = stage.problem().scene[id].centre_of_mass();
    Line line;
    for (const Eigen::Isometry3d& X : track.X_WO) line.add(X * centre);
    NoteItem item;
    item.text = stage.problem().scene[id].id;
    item.object = id;
    item.points = line.points();
    double length = 0;
    for (std::size_t k = 1; k < item.points.size(); ++k) length += (item.points[k] - item.points[k - 1]).norm();
    if (length >= kWorthALine) layer.items.push_back(std::move(item));
  }
  return layer;
}

std::vector<NoteLayer> page_layers(const Stage& stage) {
  std::vector<NoteLayer> layers;
  const Playback& playback = stage.playback();
  if (playback.recording) {
    layers.push_back(tip_path(stage));
    NoteLayer moved = object_paths(stage);
    moved.name = "motion of objects";
    layers.push_back(std::move(moved));
    layers.push_back(swept_volume(stage));
  }
  if (playback.result)
    for (const NoteLayer& layer : playback.result->notes.layers) layers.push_back(layer);
  std::erase_if(layers, [](const NoteLayer& layer) { return layer.items.empty() && layer.cells.indices.empty(); });
  return layers;
}

}  // namespace mamo::view
