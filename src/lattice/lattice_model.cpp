#include <numbers>

#include "mamo/lattice/manipulation_lattice.hpp"

namespace mamo {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Actions are numbered: [0, 2n) long primitives, [2n, 4n) short ones, kTipSteps steps of the tip, the snap onto one's
// own solution, then for each goal an extend and a snap.
constexpr std::int32_t kTipSteps = 12;
std::int32_t tip_action(int dof, int index) { return 4 * dof + index; }
std::int32_t own_snap_action(int dof) { return 4 * dof + kTipSteps; }
std::int32_t extend_action(int dof, int goal) { return own_snap_action(dof) + 1 + 2 * goal; }
std::int32_t snap_action(int dof, int goal) { return own_snap_action(dof) + 2 + 2 * goal; }
// Then the joining of link l of chain c, 4096 links a chain at most.
constexpr std::int32_t kFirstJoin = 1 << 20;
std::int32_t join_action(int chain, int link) { return kFirstJoin + (chain << 12) + link; }

constexpr double kOwnResolution = 1e-6;  // rad or m: unit of bins under kOwnConfiguration

std::int32_t steps_of(double step, double resolution) {
  return std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(step / resolution)));
}

}  // namespace

LatticeModel::LatticeModel(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                           const LatticeOptions& options, ReachGoal goal, std::vector<GoalChain> chains,
                           const TrackedPoint& point, const ObjectSet& walls)
    : problem_(problem),
      kinematics_(std::move(kinematics)),
      options_(options),
      goal_(std::move(goal)),
      chains_(std::move(chains)),
      point_(point),
      grid_(*kinematics_, point, problem.scene, walls, goal_.p_W, goal_.radius, options.heuristic_cell) {
  const Robot& robot = problem.robot;
  const int n = robot.dof();
  const Eigen::VectorXd lever = kinematics_->motion_bounds(robot.group.tip, point.p_T);
  resolution_.resize(n);
  cost_per_cell_ =
      static_cast<search::Cost>(std::floor(1000.0 * options.heuristic_cell / std::max(lever.norm(), 1e-9)));
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
  if (anchor == kOwnConfiguration) {
    Eigen::VectorXd own(static_cast<Eigen::Index>(bins.size()));
    for (std::size_t i = 0; i < bins.size(); ++i) own[static_cast<Eigen::Index>(i)] = bins[i] * kOwnResolution;
    return own;
  }
  Eigen::VectorXd q = anchor == 0 ? problem_.q_start : goal_.configurations[static_cast<std::size_t>(anchor - 1)];
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += bins[static_cast<std::size_t>(i)] * resolution_[i];
  return q;
}

search::Cost LatticeModel::cost_of(const Eigen::VectorXd& dq) const {
  return std::max<search::Cost>(1, static_cast<search::Cost>(std::ceil(1000.0 * dq.norm() - 1e-9)));
}

search::Cost LatticeModel::heuristic(const Eigen::VectorXd& q) const {
  const Eigen::Isometry3d X_WT = kinematics_->tip_pose(q);
  const int distance = grid_.distance(X_WT * point_.p_T);
  if (distance < 0) return search::kUnreachable;
  const search::Cost grid = cost_per_cell_ * std::max(0, distance - 1);
  if (const auto* joints = std::get_if<ReachJoints>(&goal_.task)) {
    const double slack = joints->tolerance * std::sqrt(static_cast<double>(q.size()));
    return std::max(grid, static_cast<search::Cost>(std::max(0.0, 1000.0 * ((q - joints->q).norm() - slack))));
  }
  const auto& pose = std::get<ReachPose>(goal_.task);
  const double angle = Eigen::AngleAxisd(X_WT.linear().transpose() * pose.X_WT.linear()).angle();
  const double turn = std::max(0.0, angle - pose.angle_tolerance) / std::sqrt(static_cast<double>(q.size()));
  return static_cast<search::Cost>((1 - options_.orientation_share) * static_cast<double>(grid) +
                                   options_.orientation_share * 1000.0 * turn);
}

LatticeModel::Nearness LatticeModel::nearness(const Eigen::VectorXd& q) const {
  const Eigen::Vector3d p = kinematics_->tip_pose(q) * point_.p_T;
  const int distance = grid_.distance(p);
  return {(p - p_start_).norm(), distance < 0 ? std::numeric_limits<double>::infinity() : distance * grid_.cell()};
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

bool LatticeModel::rounded_step(const LatticeState& state, const Eigen::VectorXd& q, const Eigen::VectorXd& dq,
                                Move& out) const {
  out.anchor = state.anchor;
  out.bins = state.bins;
  Eigen::VectorXd rounded(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto bins = static_cast<std::int32_t>(std::lround(dq[i] / resolution_[i]));
    out.bins[static_cast<std::size_t>(i)] += bins;
    rounded[i] = bins * resolution_[i];
  }
  out.cost = cost_of(rounded);
  return out.cost >= shortest_ && problem_.robot.within_limits(q + rounded);
}

bool LatticeModel::tip_step(const LatticeState& state, const Eigen::VectorXd& q, int index, Move& out) const {
  // Twist of the tip about or along one of its own axes, then damped least squares for the joints.
  const Eigen::Matrix3d R = kinematics_->tip_pose(q).linear();
  const int axis = index % 6 / 2;
  const double sign = index % 2 ? -1 : 1;
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  if (index < 6)
    twist.head<3>() = sign * options_.tip_step * R.col(axis);
  else
    twist.tail<3>() = sign * options_.tip_turn_deg * kDegree * R.col(axis);
  Eigen::Matrix<double, 6, Eigen::Dynamic> J;
  kinematics_->jacobian(q, J);
  constexpr double kDamping = 0.02;
  const Eigen::Matrix<double, 6, 6> A =
      J * J.transpose() + kDamping * kDamping * Eigen::Matrix<double, 6, 6>::Identity();
  out.action = tip_action(problem_.robot.dof(), index);
  return rounded_step(state, q, J.transpose() * A.ldlt().solve(twist), out);
}

bool LatticeModel::extend(const LatticeState& state, const Eigen::VectorXd& q, int goal, Move& out) const {
  const Eigen::VectorXd towards = goal_.configurations[static_cast<std::size_t>(goal)] - q;
  const double step = options_.extend_step_deg * kDegree, length = towards.norm();
  if (length <= step) return false;  // the snap does it
  out.action = extend_action(problem_.robot.dof(), goal);
  return rounded_step(state, q, towards * (step / length), out);
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

bool LatticeModel::own_snap(const Eigen::VectorXd& q, Move& out) const {
  const auto* pose = std::get_if<ReachPose>(&goal_.task);
  if (!pose) return false;
  IkOptions once;
  once.starts = 1;
  const auto solution = InverseKinematics(*kinematics_).solve(pose->X_WT, q, 0, once);
  if (!solution) return false;
  out.action = own_snap_action(problem_.robot.dof());
  out.anchor = kOwnConfiguration;
  out.bins.resize(static_cast<std::size_t>(q.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i)
    out.bins[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::lround((*solution)[i] / kOwnResolution));
  const Eigen::VectorXd child = configuration(out.anchor, out.bins);
  out.cost = cost_of(child - q);
  return problem_.robot.within_limits(child, kOwnResolution) && (child - q).cwiseAbs().maxCoeff() > kOwnResolution;
}

void LatticeModel::add_goals(const std::vector<Eigen::VectorXd>& configurations) {
  goal_.configurations.insert(goal_.configurations.end(), configurations.begin(), configurations.end());
}

void LatticeModel::add_chains(std::vector<GoalChain> chains) {
  chains_.insert(chains_.end(), std::make_move_iterator(chains.begin()), std::make_move_iterator(chains.end()));
}

int LatticeModel::nearest_link(const GoalChain& chain, const Eigen::VectorXd& q) const {
  const auto closer = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - q).squaredNorm() < (b - q).squaredNorm();
  };
  const auto nearest = std::min_element(chain.q.begin(), chain.q.end() - 1, closer);
  return std::min<int>(4095, static_cast<int>(nearest - chain.q.begin()));
}

std::vector<int> LatticeModel::nearest_chains(const Eigen::VectorXd& q, int count) const {
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < chains_.size(); ++k)
    order.emplace_back((chains_[k].q[static_cast<std::size_t>(nearest_link(chains_[k], q))] - q).norm(),
                       static_cast<int>(k));
  std::sort(order.begin(), order.end());
  std::vector<int> nearest;
  for (const auto& [distance, k] : order)
    if (static_cast<int>(nearest.size()) < count) nearest.push_back(k);
  return nearest;
}

bool LatticeModel::join(const Eigen::VectorXd& q, int chain, int link, Move& out) const {
  if (chain >= static_cast<int>(chains_.size())) return false;
  const GoalChain& c = chains_[static_cast<std::size_t>(chain)];
  if (link + 1 >= static_cast<int>(c.q.size())) return false;  // the last one is a goal: a snap
  out.action = join_action(chain, link);
  out.anchor = c.goal + 1;
  out.bins.assign(static_cast<std::size_t>(q.size()), 0);
  const Eigen::VectorXd* from = &q;
  double length = 0;
  for (std::size_t k = static_cast<std::size_t>(link); k < c.q.size(); from = &c.q[k++])
    length += (c.q[k] - *from).norm();
  out.cost = std::max<search::Cost>(1, static_cast<search::Cost>(std::ceil(1000.0 * length)));
  return true;
}

std::vector<Eigen::VectorXd> LatticeModel::legs(const LatticeState& state, std::int32_t action) const {
  Move m;
  action &= ~kContactForm;
  if (!move(state, action, m)) return {};
  if (action < kFirstJoin) return {configuration(m.anchor, m.bins)};
  const GoalChain& chain = chains_[static_cast<std::size_t>((action - kFirstJoin) >> 12)];
  std::vector<Eigen::VectorXd> legs;
  Eigen::VectorXd last = configuration(state.anchor, state.bins);
  for (auto q = chain.q.begin() + ((action - kFirstJoin) & 4095); q != chain.q.end(); ++q) {
    if ((*q - last).cwiseAbs().maxCoeff() < 1e-12) continue;  // standing on the link already
    legs.push_back(*q);
    last = *q;
  }
  return legs;
}

bool LatticeModel::move(const LatticeState& state, std::int32_t action, Move& out) const {
  const int n = problem_.robot.dof();
  action &= ~kContactForm;
  if (action < 4 * n) return primitive(state, action, out);
  const Eigen::VectorXd q = configuration(state.anchor, state.bins);
  if (action >= kFirstJoin) return join(q, (action - kFirstJoin) >> 12, (action - kFirstJoin) & 4095, out);
  if (action < own_snap_action(n)) return tip_step(state, q, action - 4 * n, out);
  if (action == own_snap_action(n)) return own_snap(q, out);
  const int rest = action - own_snap_action(n) - 1;
  return rest % 2 ? snap(q, rest / 2, out) : extend(state, q, rest / 2, out);
}

void LatticeModel::moves(const LatticeState& state, std::vector<Move>& out) const {
  out.clear();
  if (state.anchor != 0) return;  // a goal configuration is an end, not a way station
  const int n = problem_.robot.dof();
  const Eigen::VectorXd q = configuration(state.anchor, state.bins);
  const Nearness near = nearness(q);
  Move m;
  const int primitives = std::min(near.to_start, near.to_goal) <= options_.short_distance ? 4 * n : 2 * n;
  for (int index = 0; index < primitives; ++index)
    if (primitive(state, index, m)) out.push_back(m);
  if (options_.tip_step > 0)
    for (int index = 0; index < kTipSteps; ++index)
      if (tip_step(state, q, index, m)) out.push_back(m);
  for (int goal : nearest_goals(q, options_.extends))
    if (extend(state, q, goal, m)) out.push_back(m);
  for (int goal : nearest_goals(q, options_.snaps))
    if (snap(q, goal, m)) out.push_back(m);
  const bool at_start = std::all_of(state.bins.begin(), state.bins.end(), [](std::int32_t b) { return b == 0; });
  for (int chain : nearest_chains(q, at_start ? static_cast<int>(chains_.size()) : options_.joins))
    if (join(q, chain, nearest_link(chains_[static_cast<std::size_t>(chain)], q), m)) out.push_back(m);
  if (near.to_goal <= options_.own_snap_distance && own_snap(q, m)) out.push_back(m);
}

}  // namespace mamo
