#include "mamo/model/motion.hpp"

namespace mamo {
namespace {

/// A motion driven on its own and as a part of a longer plan meets the same instants but for the rounding of the times.
/// Contact dynamics makes millimetres of that within two seconds, so fractions of a piece are rounded far above it.
constexpr double kFractions = 1 << 30;

}  // namespace

void TimedPath::at(double time, Eigen::VectorXd& out) const {
  if (time <= t.front()) {
    out = q.front();
    return;
  }
  if (time >= t.back()) {
    out = q.back();
    return;
  }
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
  const double s = std::round((time - t[i - 1]) / (t[i] - t[i - 1]) * kFractions) / kFractions;
  if (s >= 1)
    out = q[i];
  else
    out = q[i - 1] + s * (q[i] - q[i - 1]);
}

TimedPath time_path(const Robot& robot, const std::vector<Eigen::VectorXd>& path, double step_s) {
  TimedPath timed;
  timed.t.push_back(0.0);
  timed.q.push_back(path.front());
  long steps = 0;  // whole steps, so that times do not accumulate rounding
  for (std::size_t k = 1; k < path.size(); ++k) {
    double needed = 0;
    for (int i = 0; i < robot.dof(); ++i)
      needed =
          std::max(needed, std::abs(path[k][i] - path[k - 1][i]) / (robot.joint(i).max_velocity * robot.speed_scale));
    if (needed <= 0) continue;
    steps += std::max(1L, static_cast<long>(std::ceil(needed / step_s - 1e-9)));
    timed.t.push_back(static_cast<double>(steps) * step_s);
    timed.q.push_back(path[k]);
  }
  return timed;
}

}  // namespace mamo
