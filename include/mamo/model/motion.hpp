// Joint paths with times: what a simulator drives and what a plan stores.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mamo/model/robot.hpp"

namespace mamo {

/// Piecewise linear motion of the group joints. t[0] == 0, t increasing, one q (dof values) per t.
struct TimedPath {
  std::vector<double> t;           // s
  std::vector<Eigen::VectorXd> q;  // rad or m; continuous joints unwrapped

  double duration() const { return t.empty() ? 0.0 : t.back(); }
  /// Linear interpolation, clamped to the ends. Writes dof values to `out` (resized).
  void at(double time, Eigen::VectorXd& out) const;
};

/// Times a joint path: each piece takes as long as its slowest joint needs at speed_scale of its velocity
/// limit, rounded up to a whole number of physics steps, so that planning and continuous replay sample the
/// same instants. Pieces of no motion are dropped. At least one point.
TimedPath time_path(const Robot& robot, const std::vector<Eigen::VectorXd>& path, double step_s);

}  // namespace mamo
