// Orocos KDL, finite differences and random motions as judges of forward kinematics.
#include "mamo/kinematics/forward_kinematics.hpp"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "support/robots.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 12;

KDL::Vector kdl(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
KDL::Frame kdl(const Eigen::Isometry3d& X) {
  KDL::Frame f;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) f.M(i, k) = X.linear()(i, k);
  f.p = kdl(Eigen::Vector3d(X.translation()));
  return f;
}
Eigen::Isometry3d eigen(const KDL::Frame& f) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) {
    X.translation()[i] = f.p(i);
    for (int k = 0; k < 3; ++k) X.linear()(i, k) = f.M(i, k);
  }
  return X;
}

/// The chain from the root to a link as KDL sees it: every joint of it, driven, mimicking or parked, moves by its own
/// value; `rows` maps a KDL joint to (group joint, multiplier).
struct Oracle {
  KDL::Chain chain;
  std::vector<JointId> joints;  // of the moving KDL joints
  const Robot& robot;

  Oracle(const Robot& r, LinkId link) : robot(r) {
    std::vector<JointId> path;
    for (JointId j = r.model->links[link.index()].parent_joint; j.valid();) {
      path.insert(path.begin(), j);
      j = r.model->links[r.model->joints[j.index()].parent.index()].parent_joint;
    }
    for (JointId id : path) {
      const Joint& j = r.model->joints[id.index()];
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), kdl(j.X_PJ)));
      if (j.type == JointType::fixed) continue;
      const auto type = j.type == JointType::prismatic ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
      chain.addSegment(KDL::Segment(KDL::Joint("", KDL::Vector::Zero(), kdl(j.axis), type)));
      joints.push_back(id);
    }
  }
  KDL::JntArray values(const Eigen::VectorXd& q) const {
    const Eigen::VectorXd full = robot.with_group(q);
    KDL::JntArray out(static_cast<unsigned>(joints.size()));
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Joint& j = robot.model->joints[joints[i].index()];
      out(static_cast<unsigned>(i)) =
          j.mimic ? j.mimic->multiplier * full[robot.model->joints[j.mimic->joint.index()].variable] + j.mimic->offset
                  : full[j.variable];
    }
    return out;
  }
  Eigen::Isometry3d pose(const Eigen::VectorXd& q) const {
    KDL::ChainFkSolverPos_recursive solver(chain);
    KDL::Frame frame;
    EXPECT_GE(solver.JntToCart(values(q), frame), 0);
    return robot.X_WB * eigen(frame);
  }
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& q) const {
    KDL::ChainJntToJacSolver solver(chain);
    KDL::Jacobian all(static_cast<unsigned>(joints.size()));
    EXPECT_GE(solver.JntToJac(values(q), all), 0);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, robot.dof());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Joint& j = robot.model->joints[joints[i].index()];
      const JointId driver = j.mimic ? j.mimic->joint : joints[i];
      for (int g = 0; g < robot.dof(); ++g)
        if (robot.group.joints[static_cast<std::size_t>(g)] == driver)
          J.col(g) += (j.mimic ? j.mimic->multiplier : 1.0) * all.data.col(static_cast<Eigen::Index>(i));
    }
    J.topRows<3>() = robot.X_WB.linear() * J.topRows<3>();
    J.bottomRows<3>() = robot.X_WB.linear() * J.bottomRows<3>();
    return J;
  }
};

std::vector<Robot> robots() {
  Robot placed = fixtures::pr2_like_arm();
  placed.X_WB = fixtures::at(0.3, -1, 0.2, 2.0);
  return {fixtures::pr2_like_arm(), placed, fixtures::made_up_robot()};
}

TEST(ForwardKinematics, PosesOfAllLinksAreThoseOfKdl) {
  for (const Robot& robot : robots()) {
    const ForwardKinematics kinematics(robot);
    RandomStream random(kSeed, {1});
    std::vector<Eigen::Isometry3d> X_WL;
    for (int k = 0; k < 100; ++k) {
      const Eigen::VectorXd q = fixtures::random_configuration(robot, random);
      kinematics.link_poses(q, X_WL);
      ASSERT_EQ(X_WL.size(), robot.model->links.size());
      for (std::size_t l = 0; l < X_WL.size(); ++l)
        ASSERT_TRUE(X_WL[l].isApprox(Oracle(robot, LinkId(l)).pose(q), 1e-12))
            << robot.model->name << " " << robot.model->links[l].name << ", seed " << kSeed << ", k " << k;
      ASSERT_EQ(kinematics.tip_pose(q).matrix(), X_WL[robot.group.tip.index()].matrix());
    }
  }
}

TEST(ForwardKinematics, JacobianIsThatOfKdl) {
  for (const Robot& robot : robots()) {
    const ForwardKinematics kinematics(robot);
    const Oracle oracle(robot, robot.group.tip);
    RandomStream random(kSeed, {2});
    Eigen::Matrix<double, 6, Eigen::Dynamic> J;
    for (int k = 0; k < 200; ++k) {
      const Eigen::VectorXd q = fixtures::random_configuration(robot, random);
      kinematics.jacobian(q, J);
      ASSERT_TRUE(J.isApprox(oracle.jacobian(q), 1e-12)) << robot.model->name << ", seed " << kSeed << ", k " << k;
    }
  }
}

TEST(ForwardKinematics, JacobianIsTheDerivativeOfTheTipPose) {
  const double h = 1e-6;
  for (const Robot& robot : robots()) {
    const ForwardKinematics kinematics(robot);
    RandomStream random(kSeed, {3});
    Eigen::Matrix<double, 6, Eigen::Dynamic> J;
    for (int k = 0; k < 50; ++k) {
      const Eigen::VectorXd q = fixtures::random_configuration(robot, random);
      kinematics.jacobian(q, J);
      for (int i = 0; i < robot.dof(); ++i) {
        Eigen::VectorXd forth = q, back = q;
        forth[i] += h;
        back[i] -= h;
        const Eigen::Isometry3d A = kinematics.tip_pose(back), B = kinematics.tip_pose(forth);
        const Eigen::Vector3d linear = (B.translation() - A.translation()) / (2 * h);
        const Eigen::AngleAxisd turn(B.linear() * A.linear().transpose());
        const Eigen::Vector3d angular = turn.angle() * turn.axis() / (2 * h);
        ASSERT_LT((J.col(i).head<3>() - linear).norm(), 1e-6) << "seed " << kSeed << ", k " << k << ", joint " << i;
        ASSERT_LT((J.col(i).tail<3>() - angular).norm(), 1e-6) << "seed " << kSeed << ", k " << k << ", joint " << i;
      }
    }
  }
}

TEST(ForwardKinematics, NoCollisionPointMovesFurtherThanItsBound) {
  for (const Robot& robot : robots()) {
    const ForwardKinematics kinematics(robot);
    const Eigen::VectorXd bound = kinematics.motion_bounds();
    const std::vector<bool> moving = robot.moving_links();
    RandomStream random(kSeed, {4});
    std::vector<Eigen::Isometry3d> before, after;
    double tightest = 0;
    for (int k = 0; k < 500; ++k) {
      const Eigen::VectorXd q = fixtures::random_configuration(robot, random);
      Eigen::VectorXd moved = q;
      const int joint = static_cast<int>(random.below(static_cast<std::uint64_t>(robot.dof())));
      const double step = k % 2 ? 1e-3 : random.uniform(-0.3, 0.3);
      moved[joint] += step;
      // Prismatic joints shorten or lengthen arms: the bound speaks of configurations inside the limits.
      if (!robot.within_limits(moved)) continue;
      kinematics.link_poses(q, before);
      kinematics.link_poses(moved, after);
      for (std::size_t l = 0; l < before.size(); ++l) {
        if (!moving[l]) continue;
        for (const PlacedShape& s : robot.model->links[l].collision) {
          const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
          const Eigen::Vector3d p = s.X_BS * support(s.shape, direction);
          const double distance = (before[l] * p - after[l] * p).norm();
          ASSERT_LE(distance, bound[joint] * std::abs(step) + 1e-12)
              << robot.model->name << " " << robot.model->links[l].name << ", seed " << kSeed << ", k " << k;
          const double of_point = kinematics.motion_bounds(LinkId(l), p)[joint] * std::abs(step);
          ASSERT_LE(distance, of_point + 1e-12);
          if (distance > 0) tightest = std::max(tightest, distance / of_point);
        }
      }
    }
    EXPECT_GT(tightest, 0.5) << robot.model->name << ": a bound that is never approached says little";
  }
}

}  // namespace
}  // namespace mamo
