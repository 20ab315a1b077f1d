#include "mamo/model/robot.hpp"

namespace mamo {

LinkId RobotModel::find_link(const std::string& wanted) const {
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i].name == wanted) return LinkId(i);
  return {};
}

JointId RobotModel::find_joint(const std::string& wanted) const {
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == wanted) return JointId(i);
  return {};
}

Eigen::VectorXd Robot::group_part(const Eigen::VectorXd& full) const {
  Eigen::VectorXd q(dof());
  for (int i = 0; i < dof(); ++i) q[i] = full[joint(i).variable];
  return q;
}

Eigen::VectorXd Robot::with_group(const Eigen::VectorXd& q) const {
  Eigen::VectorXd full = posture;
  for (int i = 0; i < dof(); ++i) full[joint(i).variable] = q[i];
  return full;
}

bool Robot::within_limits(const Eigen::VectorXd& q, double slack) const {
  if (q.size() != dof()) return false;
  for (int i = 0; i < dof(); ++i)
    if (!(q[i] >= joint(i).lower - slack && q[i] <= joint(i).upper + slack)) return false;  // NaN fails too
  return true;
}

std::vector<bool> Robot::moving_links() const {
  std::vector<bool> in_group(model->joints.size(), false);
  for (JointId j : group.joints) in_group[j.index()] = true;
  std::vector<bool> moves(model->links.size(), false);
  for (std::size_t i = 0; i < model->joints.size(); ++i) {
    const Joint& j = model->joints[i];
    const bool driven = in_group[i] || (j.mimic && in_group[j.mimic->joint.index()]);
    moves[j.child.index()] = driven || moves[j.parent.index()];
  }
  return moves;
}

}  // namespace mamo
