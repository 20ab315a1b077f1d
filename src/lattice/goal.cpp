#include "mamo/lattice/goal.hpp"

namespace mamo {
namespace {

constexpr int kHardStarts = 500;  // of inverse kinematics where the usual number found nothing

}  // namespace

ReachGoal make_reach_goal(const Problem& problem, const ForwardKinematics& kinematics, const TrackedPoint& point,
                          CollisionChecker& checker, const ObjectSet& walls, std::uint64_t seed, int count) {
  ReachGoal goal;
  goal.task = problem.task;
  const ObjectSet none(problem.scene.size());
  CollisionReport report;
  checker.set_state(WorldState::start_of(problem.scene));
  const auto free = [&](const Eigen::VectorXd& q) {
    const bool ok = checker.check_edge(q, q, walls, none, report);  // padded, as the edge that ends there will be
    goal.rejected_in_collision += !ok;
    return ok;
  };
  if (const auto* joints = std::get_if<ReachJoints>(&problem.task)) {
    if (free(joints->q)) goal.configurations.push_back(joints->q);
    goal.p_W = kinematics.tip_pose(joints->q) * point.p_T;
    goal.radius = kinematics.motion_bounds(problem.robot.group.tip, point.p_T).sum() * joints->tolerance;
    return goal;
  }
  const auto& pose = std::get<ReachPose>(problem.task);
  const InverseKinematics ik(kinematics);
  goal.configurations = ik.solve_many(pose.X_WT, problem.q_start, seed, count, {}, free);
  if (goal.configurations.empty()) {  // a hard pose is worth a longer look
    IkOptions longer;
    longer.starts = kHardStarts;
    goal.configurations = ik.solve_many(pose.X_WT, problem.q_start, seed, count, longer, free);
  }
  goal.ik_budget_used_up = static_cast<int>(goal.configurations.size()) < count;
  goal.p_W = pose.X_WT * point.p_T;
  goal.radius = pose.position_tolerance + pose.angle_tolerance * point.p_T.norm();
  return goal;
}

bool reaches(const ReachGoal& goal, const ForwardKinematics& kinematics, const Eigen::VectorXd& q) {
  if (const auto* joints = std::get_if<ReachJoints>(&goal.task))
    return (q - joints->q).cwiseAbs().maxCoeff() <= joints->tolerance;
  const auto& pose = std::get<ReachPose>(goal.task);
  const auto [position, angle] = pose_error(kinematics.tip_pose(q), pose.X_WT);
  return position <= pose.position_tolerance && angle <= pose.angle_tolerance;
}

}  // namespace mamo
