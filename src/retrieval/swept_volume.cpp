#include <algorithm>
#include <cmath>

#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {
namespace {

/// One convex shape along a motion: marked again when some point of it has moved too far since the last mark.
class SweptShape {
 public:
  SweptShape(const Shape& shape, LinkId link, const Eigen::Isometry3d& X_LS) : shape_(shape), link_(link), X_LS_(X_LS) {
    const Eigen::AlignedBox3d box = bounds(shape, Eigen::Isometry3d::Identity());
    for (int k = 0; k < 8; ++k) corners_.col(k) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    reach_ = (X_LS * Eigen::Vector3d::Zero()).norm() + box.diagonal().norm() / 2 + box.center().norm();
  }

  LinkId link() const { return link_; }
  /// No point of the shape is further from the link's origin (m).
  double reach() const { return reach_; }

  void visit(const std::vector<Eigen::Isometry3d>& X_WL, const Eigen::AlignedBox3d& space, double step,
             VoxelVolume& volume) {
    const Eigen::Isometry3d X_WS = X_WL[link_.index()] * X_LS_;
    // A displacement is affine in the point, so no point of the box moves further than its corners do.
    if (marked_ && moved(last_marked_, X_WS) > step && pending_) mark(last_, space, volume);
    if (!marked_) mark(X_WS, space, volume);
    last_ = X_WS;
    pending_ = true;
  }
  void finish(const Eigen::AlignedBox3d& space, VoxelVolume& volume) {
    if (pending_) mark(last_, space, volume);
    marked_ = pending_ = false;
  }

 private:
  double moved(const Eigen::Isometry3d& A, const Eigen::Isometry3d& B) const {
    const Eigen::Matrix<double, 3, 8> d =
        ((B.linear() - A.linear()) * corners_).colwise() + (B.translation() - A.translation());
    return std::sqrt(d.colwise().squaredNorm().maxCoeff());
  }
  void mark(const Eigen::Isometry3d& X_WS, const Eigen::AlignedBox3d& space, VoxelVolume& volume) {
    if (space.intersects(bounds(shape_, X_WS))) volume.add(shape_, X_WS);
    last_marked_ = X_WS;
    marked_ = true;
    pending_ = false;
  }

  const Shape& shape_;
  LinkId link_;
  Eigen::Isometry3d X_LS_;
  Eigen::Matrix<double, 3, 8> corners_;
  double reach_ = 0;
  Eigen::Isometry3d last_marked_, last_;
  bool marked_ = false, pending_ = false;
};

class Sweep {
 public:
  /// Marks in `volume`, what lies inside `space`.
  Sweep(const ForwardKinematics& kinematics, const Eigen::AlignedBox3d& space, VoxelVolume& volume)
      : kinematics_(kinematics), space_(space), step_(volume.cell() / 2), volume_(volume) {
    const Robot& robot = kinematics.robot();
    const std::vector<bool> moves = robot.moving_links();
    travel_ = Eigen::VectorXd::Zero(robot.dof());
    for (std::size_t i = 0; i < moves.size(); ++i)
      if (moves[i])
        for (const PlacedShape& s : robot.model->links[i].collision) add(s.shape, LinkId(i), s.X_BS);
  }

  void add(const Shape& shape, LinkId link, const Eigen::Isometry3d& X_LS) {
    shapes_.emplace_back(shape, link, X_LS);
    travel_ = travel_.cwiseMax(kinematics_.motion_bounds(link, Eigen::Vector3d(shapes_.back().reach(), 0, 0)));
  }

  void along(const std::vector<Eigen::VectorXd>& path) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Eigen::VectorXd dq = k ? Eigen::VectorXd(path[k] - path[k - 1]) : Eigen::VectorXd::Zero(path[k].size());
      const int pieces = std::max(1, static_cast<int>(std::ceil(dq.cwiseAbs().dot(travel_) / (step_ / 2))));
      for (int i = 1; i <= pieces; ++i) {
        kinematics_.link_poses(path[k] - dq * (1.0 - static_cast<double>(i) / pieces), X_WL_);
        for (SweptShape& shape : shapes_) shape.visit(X_WL_, space_, step_, volume_);
      }
    }
    for (SweptShape& shape : shapes_) shape.finish(space_, volume_);
  }

 private:
  const ForwardKinematics& kinematics_;
  Eigen::AlignedBox3d space_;
  double step_;  // m
  VoxelVolume& volume_;
  std::vector<SweptShape> shapes_;
  Eigen::VectorXd travel_;  // m per unit of each joint, of any point of any shape
  std::vector<Eigen::Isometry3d> X_WL_;
};

}  // namespace

VoxelVolume swept_volume(const Problem& problem, const ForwardKinematics& kinematics, const RetrievalPath& path,
                         const GraspCandidate& grasp, const WorldState& state, const Eigen::AlignedBox3d& bounds,
                         double cell) {
  VoxelVolume volume(bounds, cell);
  Sweep sweep(kinematics, bounds, volume);
  sweep.along(path.approach);
  sweep.along(path.reach);
  const ObjectId object = std::get<Retrieve>(problem.task).object;
  const Eigen::Isometry3d X_TO = grasp.X_WT.inverse() * state.X_WO(object);
  for (const PlacedShape& s : problem.scene[object].shapes) sweep.add(s.shape, problem.robot.group.tip, X_TO * s.X_BS);
  sweep.along(path.extract);
  return volume;
}

void add_arm_sweep(VoxelVolume& volume, const ForwardKinematics& kinematics, const std::vector<Eigen::VectorXd>& path) {
  const Eigen::Vector3d top = volume.origin() + volume.cell() * volume.size().cast<double>();
  Sweep(kinematics, Eigen::AlignedBox3d(volume.origin(), top), volume).along(path);
}

Eigen::AlignedBox3d object_space(const Scene& scene) {
  Eigen::AlignedBox3d objects;
  for (const Object& object : scene.objects)
    if (!object.fixture())
      for (const PlacedShape& s : object.shapes) objects.extend(bounds(s.shape, object.X_WO * s.X_BS));
  Eigen::AlignedBox3d space = objects;
  for (const Object& object : scene.objects) {
    if (!object.fixture() || object.constraints.touch != Touch::support) continue;
    Eigen::AlignedBox3d support;
    for (const PlacedShape& s : object.shapes) support.extend(bounds(s.shape, object.X_WO * s.X_BS));
    // Under something: seen from above they overlap, and its top is no higher than the lowest object's foot may be.
    const bool under = (support.min().head<2>().array() <= objects.max().head<2>().array()).all() &&
                       (support.max().head<2>().array() >= objects.min().head<2>().array()).all() &&
                       support.min().z() <= objects.min().z();
    if (!under) continue;
    space.min().head<2>() = space.min().head<2>().cwiseMin(support.min().head<2>());
    space.max().head<2>() = space.max().head<2>().cwiseMax(support.max().head<2>());
  }
  return space;
}

}  // namespace mamo
