#include "push/gripper.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::push {
namespace {

constexpr double kSpacing = 0.015;  // m between neighbouring points of a surface

/// Points of the shape's surface: a grid on its bounding box, each drawn to the shape's farthest point when outside.
void add_points(const PlacedShape& placed, const Eigen::Isometry3d& X_TL, std::vector<Eigen::Vector3d>& out) {
  const Eigen::AlignedBox3d box = bounds(placed.shape, Eigen::Isometry3d::Identity());
  const Eigen::Vector3d size = box.sizes();
  Eigen::Vector3i n;
  for (int i = 0; i < 3; ++i) n[i] = std::max(1, static_cast<int>(std::ceil(size[i] / kSpacing)));
  const Eigen::Isometry3d X_TS = X_TL * placed.X_BS;
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k) {
        if (i % n[0] && j % n[1] && k % n[2]) continue;  // inner
        const Eigen::Vector3d p =
            box.min() + size.cwiseProduct(Eigen::Vector3d(i, j, k).cwiseQuotient(n.cast<double>()));
        if (signed_distance(placed.shape, p) <= 1e-6) out.push_back(X_TS * p);
      }
  for (int k = 0; k < 26; ++k) {
    const int code = k < 13 ? k : k + 1;
    const Eigen::Vector3d direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    out.push_back(X_TS * support(placed.shape, direction));
  }
}

}  // namespace

Gripper::Gripper(const ForwardKinematics& kinematics) {
  const Robot& robot = kinematics.robot();
  const RobotModel& model = *robot.model;
  const Eigen::VectorXd qa = robot.group_part(robot.posture);
  const Eigen::VectorXd qb = qa + Eigen::VectorXd::LinSpaced(robot.dof(), 0.1, 0.2);
  std::vector<Eigen::Isometry3d> A, B;
  kinematics.link_poses(qa, A);
  kinematics.link_poses(qb, B);
  const std::size_t tip = robot.group.tip.index();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Eigen::Isometry3d X_TL = A[tip].inverse() * A[i];
    if (!X_TL.isApprox(B[tip].inverse() * B[i], 1e-9)) continue;
    for (const PlacedShape& placed : model.links[i].collision) add_points(placed, X_TL, p_TQ_);
  }
}

bool Gripper::surely_hits(const Scene& scene, const WorldState& state, const ObjectSet& against,
                          const Eigen::Isometry3d& X_WT) const {
  for (const ObjectId id : against.ids()) {
    const Eigen::Isometry3d X_WO = state.X_WO(id);
    for (const PlacedShape& placed : scene[id].shapes) {
      const Eigen::Isometry3d X_ST = (X_WO * placed.X_BS).inverse() * X_WT;
      for (const Eigen::Vector3d& p : p_TQ_)
        if (signed_distance(placed.shape, X_ST * p) < 0) return true;
    }
  }
  return false;
}

double Gripper::reach(const Eigen::Matrix3d& R_WT, const Eigen::Vector3d& d_W, double half_width) const {
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(d_W);  // zero for a vertical d_W: every point counts
  double farthest = 0;
  for (const Eigen::Vector3d& p_T : p_TQ_) {
    const Eigen::Vector3d p = R_WT * p_T;
    if (std::abs(p.dot(across)) <= half_width) farthest = std::max(farthest, p.dot(d_W));
  }
  return farthest;
}

}  // namespace mamo::push
