#include <numbers>

#include "mamo/lattice/manipulation_lattice.hpp"

namespace mamo {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Actions are numbered: [0, 2n) long primitives, [2n, 4n) short ones, then goal k gives extend 4n + 2k, snap 4n + 2k + 1.
std::int32_t extend_action(int dof, int goal) { return 4 * dof + 2 * goal; }
std::int32_t snap_action(int dof, int goal) { return 4 * dof + 2 * goal + 1; }

std::int32_t steps_of(double step, double resolution) {
  return std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(step / resolution)));
}

}  // namespace

LatticeModel::LatticeModel(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                           const LatticeOptions& options, ReachGoal goal, const TrackedPoint& point,
                           const ObjectSet& walls)
    : problem_(problem),
      kinematics_(std::move(kinematics)),
      options_(options),
      goal_(std::move(goal)),
      point_(point),
      grid_(*kinematics_, point, problem.scene, walls, goal_.p_W, goal_.radius, options.heuristic_cell) {
  const Robot& robot = problem.robot;
  const int n = robot.dof();
  const Eigen::VectorXd lever = kinematics_->motion_bounds(robot.group.tip, point.p_T);
  resolution_.resize(n);
  cost_per_cell_ = static_cast<search::Cost>(std::floor(1000.0 * options.heuristic_cell / std::max(lever.norm(), 1e-9)));
  shortest_ = search::kUnreachable;
  for (int i = 0; i < n; ++i) {
    // A prismatic joint moves as far per bin as a revolute one of the configured resolution does at half a metre.
    const bool prismatic = robot.joint(i).type == JointType::prismatic;
    resolution_[i] = prismatic ? options.prismatic_resolution : options.joint_resolution_deg * kDegree;
    const double scale = prismatic ? 0.5 * kDegree : kDegree;
    long_.push_back(steps_of(options.long_step_deg * scale, resolution_[i]));
    short_.push_back(steps_of(options.short_step_deg * scale, resolution_[i]));
    for (std::int32_t bins : {long_.back(), short_.back()}) {
      const double dq = bins * resolution_[i];
      const auto cost = static_cast<search::Cost>(std::ceil(1000.0 * dq));
      const auto cells = static_cast<search::Cost>(std::floor(lever[i] * dq / options.heuristic_cell)) + 1;
      cost_per_cell_ = std::min(cost_per_cell_, cost / cells);
      shortest_ = std::min(shortest_, cost);
    }
  }
  // Steps towards a goal are at least as long as the shortest primitive: cost c, travel <= |lever| c.
  const double travel = lever.norm() * static_cast<double>(shortest_) / 1000.0;
  const auto cells = static_cast<search::Cost>(std::floor(travel / options.heuristic_cell)) + 1;
  cost_per_cell_ = std::max<search::Cost>(1, std::min(cost_per_cell_, shortest_ / cells));
  p_start_ = kinematics_->tip_pose(problem.q_start) * point.p_T;
}

Eigen::VectorXd LatticeModel::configuration(std::int32_t anchor, const std::vector<std::int32_t>& bins) const {
  Eigen::VectorXd q = anchor == 0 ? problem_.q_start : goal_.configurations[static_cast<std::size_t>(anchor - 1)];
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += bins[static_cast<std::size_t>(i)] * resolution_[i];
  return q;
}

search::Cost LatticeModel::cost_of(const Eigen::VectorXd& dq) const {
  return std::max<search::Cost>(1, static_cast<search::Cost>(std::ceil(1000.0 * dq.norm() - 1e-9)));
}

search::Cost LatticeModel::heuristic(const Eigen::VectorXd& q) const {
  const int distance = grid_.distance(kinematics_->tip_pose(q) * point_.p_T);
  if (distance < 0) return search::kUnreachable;
  return cost_per_cell_ * std::max(0, distance - 1);
}

bool LatticeModel::near_ends(const Eigen::VectorXd& q) const {
  const Eigen::Vector3d p = kinematics_->tip_pose(q) * point_.p_T;
  const int distance = grid_.distance(p);
  return (p - p_start_).norm() <= options_.short_distance ||
         (distance >= 0 && distance * grid_.cell() <= options_.short_distance);
}

std::vector<int> LatticeModel::nearest_goals(const Eigen::VectorXd& q, int count) const {
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < goal_.configurations.size(); ++k)
    order.emplace_back((goal_.configurations[k] - q).norm(), static_cast<int>(k));
  std::sort(order.begin(), order.end());
  std::vector<int> nearest;
  for (const auto& [distance, k] : order)
    if (static_cast<int>(nearest.size()) < count) nearest.push_back(k);
  return nearest;
}

bool LatticeModel::primitive(const LatticeState& state, int index, Move& out) const {
  const int n = problem_.robot.dof();
  const bool is_short = index >= 2 * n;
  const int joint = index % (2 * n) / 2;
  const std::int32_t step = (is_short ? short_ : long_)[static_cast<std::size_t>(joint)];
  out.action = index;
  out.anchor = state.anchor;
  out.bins = state.bins;
  out.bins[static_cast<std::size_t>(joint)] += index % 2 ? -step : step;
  out.cost = static_cast<search::Cost>(std::ceil(1000.0 * step * resolution_[joint]));
  return problem_.robot.within_limits(configuration(out.anchor, out.bins));
}

bool LatticeModel::extend(const LatticeState& state, const Eigen::VectorXd& q, int goal, Move& out) const {
  const Eigen::VectorXd towards = goal_.configurations[static_cast<std::size_t>(goal)] - q;
  const double step = options_.extend_step_deg * kDegree, length = towards.norm();
  if (length <= step) return false;  // the snap does it
  out.action = extend_action(problem_.robot.dof(), goal);
  out.anchor = state.anchor;
  out.bins = state.bins;
  Eigen::VectorXd dq(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto bins = static_cast<std::int32_t>(std::lround(towards[i] * (step / length) / resolution_[i]));
    out.bins[static_cast<std::size_t>(i)] += bins;
    dq[i] = bins * resolution_[i];
  }
  out.cost = cost_of(dq);
  return out.cost >= shortest_ && problem_.robot.within_limits(q + dq);
}

bool LatticeModel::snap(const Eigen::VectorXd& q, int goal, Move& out) const {
  const Eigen::VectorXd dq = goal_.configurations[static_cast<std::size_t>(goal)] - q;
  if (dq.cwiseAbs().maxCoeff() < 1e-12) return false;
  out.action = snap_action(problem_.robot.dof(), goal);
  out.anchor = goal + 1;
  out.bins.assign(static_cast<std::size_t>(q.size()), 0);
  out.cost = cost_of(dq);
  return true;
}

bool LatticeModel::move(const LatticeState& state, std::int32_t action, Move& out) const {
  const int n = problem_.robot.dof();
  if (action < 4 * n) return primitive(state, action, out);
  const Eigen::VectorXd q = configuration(state.anchor, state.bins);
  const int goal = (action - 4 * n) / 2;
  return action % 2 ? snap(q, goal, out) : extend(state, q, goal, out);
}

void LatticeModel::moves(const LatticeState& state, std::vector<Move>& out) const {
  out.clear();
  const int n = problem_.robot.dof();
  const Eigen::VectorXd q = configuration(state.anchor, state.bins);
  Move m;
  const int primitives = near_ends(q) ? 4 * n : 2 * n;
  for (int index = 0; index < primitives; ++index)
    if (primitive(state, index, m)) out.push_back(m);
  for (int goal : nearest_goals(q, options_.extends))
    if (extend(state, q, goal, m)) out.push_back(m);
  for (int goal : nearest_goals(q, options_.snaps))
    if (snap(q, goal, m)) out.push_back(m);
}

}  // namespace mamo
