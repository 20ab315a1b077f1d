#include "mamo/model/world_state.hpp"

namespace mamo {
namespace {

std::int32_t rounded(double x) { return static_cast<std::int32_t>(std::lround(std::clamp(x * 1e6, -2.0e9, 2.0e9))); }

}  // namespace

QuantisedPose quantise(const Eigen::Isometry3d& X) {
  Eigen::Quaterniond q(X.linear());
  q.normalize();
  QuantisedPose out;
  for (std::size_t i = 0; i < 3; ++i) out.p[i] = rounded(X.translation()[static_cast<Eigen::Index>(i)]);
  out.q = {rounded(q.x()), rounded(q.y()), rounded(q.z()), rounded(q.w())};
  // q and -q are one rotation: the last non-zero component, read from w, is positive.
  for (std::size_t i = 4; i-- > 0;) {
    if (out.q[i] == 0) continue;
    if (out.q[i] < 0)
      for (auto& c : out.q) c = -c;
    break;
  }
  return out;
}

Eigen::Isometry3d dequantise(const QuantisedPose& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(pose.p[0], pose.p[1], pose.p[2]) * 1e-6;
  X.linear() = Eigen::Quaterniond(pose.q[3], pose.q[0], pose.q[1], pose.q[2]).normalized().toRotationMatrix();
  return X;
}

WorldState WorldState::start_of(const Scene& scene) {
  WorldState state;
  state.poses.reserve(scene.size());
  for (const Object& o : scene.objects) state.poses.push_back(quantise(o.X_WO));
  return state;
}

}  // namespace mamo
