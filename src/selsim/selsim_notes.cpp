#include "selsim/selsim_notes.hpp"

#include <algorithm>

namespace mamo {
namespace {

constexpr int kTipPoints = 12;   // along a refuted motion
constexpr double kSlice = 0.04;  // m, cells of the slice through the heuristic
constexpr double kReach = 1.4;   // m, to each side of the goal

std::string name_of(const Scene& scene, ObjectId id) {
  return id == kRobot ? "the robot" : id.valid() ? scene[id].id : "";
}

std::string cause(const Scene& scene, const Violation& v) {
  std::string text(to_string(v.kind));
  if (v.object != kNoObject) text += " of " + name_of(scene, v.object);
  if (v.other.valid()) text += " and " + name_of(scene, v.other);
  return text;
}

NoteLayer grid_slice(const Problem& problem, const LatticeModel& model) {
  NoteLayer layer;
  layer.name = "heuristic";
  layer.about =
      "Steps of the grid heuristic to the goal, at the goal's height: blue is near, red is far, nothing is "
      "walled off or out of reach.";
  Eigen::Vector3d goal = model.kinematics().tip_pose(problem.q_start).translation();
  if (const auto* reach = std::get_if<ReachPose>(&problem.task)) goal = reach->X_WT.translation();
  if (const auto* joints = std::get_if<ReachJoints>(&problem.task))
    goal = model.kinematics().tip_pose(joints->q).translation();
  layer.cells.cell = kSlice;
  layer.cells.origin = goal - Eigen::Vector3d(kReach, kReach, kSlice / 2);
  const int side = static_cast<int>(2 * kReach / kSlice);
  std::vector<int> steps;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const int distance = model.grid().distance(layer.cells.origin + kSlice * Eigen::Vector3d(i + 0.5, j + 0.5, 0.5));
      if (distance < 0) continue;
      layer.cells.indices.push_back({i, j, 0});
      steps.push_back(distance);
    }
  const int most = steps.empty() ? 1 : std::max(1, *std::max_element(steps.begin(), steps.end()));
  for (int distance : steps) layer.cells.values.push_back(static_cast<double>(distance) / most);
  return layer;
}

}  // namespace

void SelSimNotes::refuted(int iteration, const Problem& problem, const ForwardKinematics& kinematics,
                          const Eigen::VectorXd& from, const Eigen::VectorXd& to, const WorldState& state,
                          const Violation& violation) {
  Refuted entry{iteration, violation, {}, state, kNoObject};
  if (entry.state.poses.empty()) entry.state = WorldState::start_of(problem.scene);
  for (int k = 0; k <= kTipPoints; ++k)
    entry.tip.push_back(kinematics.tip_pose(from + (to - from) * (static_cast<double>(k) / kTipPoints)).translation());
  refuted_.push_back(std::move(entry));
}

void SelSimNotes::learned(ObjectId became) {
  if (!refuted_.empty()) refuted_.back().became = became;
}

PlanningNotes SelSimNotes::take(const Problem& problem, const LatticeModel& model) const {
  const Scene& scene = problem.scene;
  NoteLayer relevant{"relevant objects",
                     "Which object each planning iteration made known, and from which violation: the line leads from "
                     "the object that broke a constraint to the one that became relevant.",
                     {},
                     {}};
  NoteLayer motions{"failed motions", "The motions of found paths that the replay with every object refuted.", {}, {}};
  for (const Refuted& entry : refuted_) {
    const auto centre = [&](ObjectId id) { return Eigen::Vector3d(entry.state.X_WO(id) * scene[id].centre_of_mass()); };
    const ObjectId broke = entry.violation.object;
    motions.items.push_back({cause(scene, entry.violation), entry.tip, broke, entry.iteration});
    if (!entry.became.valid()) continue;
    NoteItem item{
        scene[entry.became].id + ", because of " + cause(scene, entry.violation), {}, entry.became, entry.iteration};
    if (broke.valid() && broke != entry.became && !scene[broke].fixture()) item.points.push_back(centre(broke));
    item.points.push_back(centre(entry.became));
    relevant.items.push_back(std::move(item));
  }
  return {{std::move(relevant), std::move(motions), grid_slice(problem, model)}};
}

}  // namespace mamo
