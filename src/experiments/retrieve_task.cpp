#include "experiments/retrieve_task.hpp"

#include <cmath>
#include <numbers>

#include "mamo/experiments/household.hpp"

namespace mamo {
namespace {

constexpr double kPregraspGap = 0.045;                // m between the tip and the object's furthest side
constexpr double kHandAtHome[2] = {0.3753, -0.5777};  // m, the shipped PR2's tip at its home configuration

}  // namespace

Retrieve retrieve_task(const Problem& problem, ObjectId object, double turn) {
  const Object& target = problem.scene[object];
  const Eigen::Vector3d p = target.X_WO.translation();
  double yaw = std::atan2(p.y() - kHandAtHome[1], p.x() - kHandAtHome[0]) + turn;
  double reach = footprint_radius(target.shapes[0].shape);
  if (const Box* box = std::get_if<Box>(&target.shapes[0].shape)) {
    const double own = std::atan2(target.X_WO.linear()(1, 0), target.X_WO.linear()(0, 0));
    const double quarter = std::numbers::pi / 2;
    yaw = own + quarter * std::round((yaw - own) / quarter);
    reach = std::max(box->size.x(), box->size.y()) / 2;
  }
  Retrieve task;
  task.object = object;
  task.X_WT_pregrasp.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  task.X_WT_pregrasp.translation() = p - (reach + kPregraspGap) * task.X_WT_pregrasp.linear().col(0);
  task.home = problem.q_start;
  return task;
}

}  // namespace mamo
