// Which generated problems are toys: solvable without touching anything.
#include "mamo/collision/collision_checker.hpp"
#include "mamo/experiments/tabletop.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"

namespace mamo {
namespace {

/// What is left of a shape when `d` is taken off everywhere; nothing for shapes too thin and for meshes.
std::optional<Shape> eroded(const Shape& shape, double d) {
  if (const Box* box = std::get_if<Box>(&shape)) {
    const Eigen::Vector3d size = box->size - Eigen::Vector3d::Constant(2 * d);
    if (size.minCoeff() > 0) return Box{size};
  } else if (const Cylinder* c = std::get_if<Cylinder>(&shape)) {
    if (c->radius > d && c->length > 2 * d) return Cylinder{c->radius - d, c->length - 2 * d};
  } else if (const Sphere* s = std::get_if<Sphere>(&shape)) {
    if (s->radius > d) return Sphere{s->radius - d};
  }
  return std::nullopt;
}

/// Links that are fixed to the tip: the tip's own subtree and ancestors up to the last joint that moves.
std::vector<bool> fixed_to_tip(const Robot& robot) {
  const RobotModel& model = *robot.model;
  const std::vector<bool> moves = robot.moving_links();
  const auto joint_moves = [&](const Joint& j) {
    const JointId driver = j.mimic ? j.mimic->joint : model.links[j.child.index()].parent_joint;
    return std::find(robot.group.joints.begin(), robot.group.joints.end(), driver) != robot.group.joints.end();
  };
  LinkId top = robot.group.tip;
  while (model.links[top.index()].parent_joint.valid() &&
         !joint_moves(model.joints[model.links[top.index()].parent_joint.index()]))
    top = model.joints[model.links[top.index()].parent_joint.index()].parent;
  std::vector<bool> fixed(model.links.size(), false);
  fixed[top.index()] = moves[top.index()];
  for (const Joint& j : model.joints)
    if (fixed[j.parent.index()] && !joint_moves(j)) fixed[j.child.index()] = true;
  return fixed;
}

/// The same arm, of which only the links fixed to the tip are solid, and less so by what the tolerances allow.
Robot with_eroded_hand(const Robot& robot, const ReachPose& goal, const Eigen::VectorXd& q) {
  std::vector<Eigen::Isometry3d> X_WL;
  ForwardKinematics(robot).link_poses(q, X_WL);
  const Eigen::Vector3d tip = X_WL[robot.group.tip.index()].translation();
  auto model = std::make_shared<RobotModel>(*robot.model);
  const std::vector<bool> fixed = fixed_to_tip(robot);
  for (std::size_t i = 0; i < model->links.size(); ++i) {
    std::vector<PlacedShape> kept;
    for (const PlacedShape& placed : model->links[i].collision) {
      const Eigen::AlignedBox3d box = bounds(placed.shape, X_WL[i] * placed.X_BS);
      const double lever = (box.min() - tip).cwiseAbs().cwiseMax((box.max() - tip).cwiseAbs()).norm();
      const auto left = eroded(placed.shape, goal.position_tolerance + goal.angle_tolerance * lever);
      if (fixed[i] && left) kept.push_back({*left, placed.X_BS});
    }
    model->links[i].collision = std::move(kept);
  }
  Robot hand = robot;
  hand.model = std::move(model);
  hand.self_pairs.clear();
  return hand;
}

}  // namespace

bool goal_needs_contact(const Problem& problem) {
  const auto* goal = std::get_if<ReachPose>(&problem.task);
  if (!goal) return false;
  const ForwardKinematics kinematics(problem.robot);
  const auto q = InverseKinematics(kinematics).solve(goal->X_WT, problem.q_start, 1);
  if (!q) return false;
  const Robot hand = with_eroded_hand(problem.robot, *goal, *q);
  CollisionChecker checker(std::make_shared<ForwardKinematics>(hand), problem.scene);
  CollisionReport report;
  checker.check(*q, ObjectSet::of_kind(problem.scene, ObjectKind::movable), true, report);
  return !report.touched.empty();
}

std::string ContactFreeCount::text() const {
  std::string line = "of " + std::to_string(problems) + " problems ";
  if (solved + not_solved > 0 || certainly_not == problems)
    line += std::to_string(solved) + " are solvable touching nothing";
  else
    line += "at most " + std::to_string(problems - certainly_not) + " are solvable touching nothing";
  return line + " (" + std::to_string(certainly_not) + " cannot be: an object stands in the goal)";
}

ContactFreeCount count_contact_free(const std::vector<Problem>& problems,
                                    const std::function<bool(const Problem&)>& solves_untouched) {
  ContactFreeCount count;
  for (const Problem& problem : problems) {
    ++count.problems;
    if (goal_needs_contact(problem))
      ++count.certainly_not;
    else if (solves_untouched)
      ++(solves_untouched(problem) ? count.solved : count.not_solved);
  }
  return count;
}

}  // namespace mamo
