#include "view/plan_path.hpp"

#include <algorithm>

namespace mamo::view {
namespace {

/// Group index per named joint; empty if a name is unknown.
std::optional<std::vector<int>> indices_of(const Robot& robot, const std::vector<std::string>& names) {
  std::vector<int> indices;
  for (const std::string& name : names) {
    int index = 0;
    while (index < robot.dof() && robot.joint(index).name != name) ++index;
    if (index == robot.dof()) return std::nullopt;
    indices.push_back(index);
  }
  return indices;
}

}  // namespace

std::vector<SegmentPath> segment_paths(const Problem& problem, const Plan& plan) {
  std::vector<SegmentPath> paths;
  Eigen::VectorXd q = problem.q_start;
  for (const Segment& segment : plan.segments) {
    const auto indices = indices_of(problem.robot, segment.joint_names);
    if (!indices) continue;
    SegmentPath path{segment.kind, segment.object, {}};
    for (const Eigen::VectorXd& point : segment.motion.q) {
      if (point.size() != static_cast<Eigen::Index>(indices->size())) continue;
      for (std::size_t i = 0; i < indices->size(); ++i) q[(*indices)[i]] = point[static_cast<Eigen::Index>(i)];
      path.q.push_back(q);
    }
    if (!path.q.empty()) paths.push_back(std::move(path));
  }
  return paths;
}

std::map<ObjectId, Eigen::Isometry3d> final_poses(const Problem& problem, const Plan& plan) {
  std::map<ObjectId, Eigen::Isometry3d> poses;
  for (const Segment& segment : plan.segments)
    for (const auto& [id, X_WO] : segment.objects_after)
      if (id.valid() && id.index() < problem.scene.size()) poses[id] = X_WO;
  return poses;
}

}  // namespace mamo::view
