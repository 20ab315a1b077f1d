#include "retrieval/tip_line.hpp"

#include <algorithm>
#include <cmath>

namespace mamo::retrieval {
namespace {

// The most that a joint may turn per metre of the tip: with it, the tip strays from the line by less than 1 mm between
// configurations 1 cm apart, and a change of posture is no motion along the line.
constexpr double kLargestTurn = 12.0;  // rad/m

}  // namespace

std::size_t line_points(const Eigen::Vector3d& shift, double step) {
  return 1 + static_cast<std::size_t>(std::max(1.0, std::ceil(shift.norm() / step - 1e-9)));
}

std::vector<Eigen::VectorXd> follow_line(const InverseKinematics& ik, const Eigen::VectorXd& q,
                                         const Eigen::Isometry3d& X_WT, const Eigen::Vector3d& shift, double step) {
  IkOptions options;
  options.starts = 1;  // the configuration before, and no other
  const std::size_t points = line_points(shift, step);
  const double piece = shift.norm() / static_cast<double>(points - 1);
  std::vector<Eigen::VectorXd> line{q};
  for (std::size_t k = 1; k < points; ++k) {
    Eigen::Isometry3d X = X_WT;
    X.translation() += shift * (static_cast<double>(k) / static_cast<double>(points - 1));
    const std::optional<Eigen::VectorXd> next = ik.solve(X, line.back(), 0, options);
    if (!next || (*next - line.back()).cwiseAbs().maxCoeff() > std::max(kLargestTurn * piece, 0.01)) break;
    line.push_back(*next);
  }
  return line;
}

}  // namespace mamo::retrieval
