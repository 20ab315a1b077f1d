#include "retrieval/legs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mamo::retrieval {
namespace {

constexpr double kTouching = 0.001;  // m: what is nearer to the object than this is what it stands on
constexpr double kTiltSlack = 0.05;  // rad beyond the tilt at home, where home itself is beyond the limit
constexpr double kAcceptStep = 0.1;  // rad, between two looks at the tilt

ObjectSet without(ObjectSet set, const ObjectSet& taken) {
  for (ObjectId id : taken.ids()) set.erase(id);
  return set;
}

}  // namespace

Surroundings::Surroundings(const Problem& problem_in, std::shared_ptr<const ForwardKinematics> kinematics_in,
                           double max_object_tilt_rad)
    : problem(problem_in),
      kinematics(std::move(kinematics_in)),
      max_object_tilt(max_object_tilt_rad),
      fixtures(ObjectSet::of_kind(problem.scene, ObjectKind::fixture)),
      immovables(ObjectSet::of_kind(problem.scene, ObjectKind::immovable)) {
  immovables.erase(task().object);
}

Legs::Legs(const Surroundings& around, CollisionChecker& checker, const WorldState& state, const ObjectSet& obstacles)
    : around_(around),
      checker_(checker),
      state_(state),
      avoided_(around.immovables),
      supports_(around.problem.scene.size()) {
  checker_.detach();
  checker_.set_state(state);
  const ObjectId object = around.task().object;
  for (ObjectId id : obstacles.ids())
    if (id != object) avoided_.insert(id);
  avoided_with_object_ = avoided_;
  avoided_with_object_.insert(object);
  for (const auto& [a, b] : checker_.overlapping_objects(-kTouching)) {
    if (a == object) supports_.insert(b);
    if (b == object) supports_.insert(a);
  }
  fixtures_clear_ = without(around.fixtures, supports_);
  avoided_clear_ = without(avoided_, supports_);
}

void Legs::grip(const Eigen::VectorXd& q_grasp) {
  const Eigen::Isometry3d X_WT = around_.kinematics->tip_pose(q_grasp);
  X_TO_ = X_WT.inverse() * state_.X_WO(around_.task().object);
  up_T_ = X_WT.linear().transpose() * Eigen::Vector3d::UnitZ();
  checker_.detach();
  held_ = false;
}

void Legs::hold(bool held) {
  if (held == held_) return;
  if (held)
    checker_.attach(around_.task().object, around_.problem.robot.group.tip, X_TO_);
  else
    checker_.detach();
  held_ = held;
}

bool Legs::edge(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const ObjectSet& forbidden,
                const ObjectSet& avoided) {
  if (checker_.check_edge(a, b, forbidden, avoided, report_) && report_.touched.empty()) return true;
  hit_ = report_.self ? "itself" : around_.problem.scene[report_.touched.front()].id;
  return false;
}

bool Legs::free(Phase phase, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  hold(phase == Phase::leave || phase == Phase::carry);
  switch (phase) {
    case Phase::approach:
      return edge(a, b, around_.fixtures, avoided_with_object_);
    case Phase::reach:
      return edge(a, b, around_.fixtures, avoided_);
    case Phase::carry:
      return edge(a, b, around_.fixtures, avoided_);
    case Phase::leave:
      if (!edge(a, b, fixtures_clear_, avoided_clear_)) return false;
      hold(false);
      return edge(a, b, around_.fixtures, avoided_);
  }
  return false;
}

bool Legs::free(Phase phase, const std::vector<Eigen::VectorXd>& path) {
  return free_points(phase, path) == path.size();
}

std::size_t Legs::free_points(Phase phase, const std::vector<Eigen::VectorXd>& path) {
  if (path.empty() || !free(phase, path.front())) return 0;
  std::size_t k = 1;
  while (k < path.size() && free(phase, path[k - 1], path[k])) ++k;
  return k;
}

void Legs::collect(Phase phase, const Eigen::VectorXd& a, const Eigen::VectorXd& b, ObjectSet& touched) {
  hold(phase == Phase::leave || phase == Phase::carry);
  checker_.check_edge(a, b, ObjectSet(), avoided_, report_);
  for (ObjectId id : report_.touched) touched.insert(id);
}

double Legs::tilt(const Eigen::VectorXd& q) const {
  return std::acos(std::clamp((around_.kinematics->tip_pose(q).linear() * up_T_).z(), -1.0, 1.0));
}

std::vector<Eigen::VectorXd> Legs::search(Phase phase, const Eigen::VectorXd& from, std::vector<Eigen::VectorXd> goals,
                                          RandomStream random, const JointPathOptions& options, StopSource* stop) {
  const bool held = phase == Phase::carry;
  hold(held);
  const double at_ends = std::max(tilt(from), tilt(around_.task().home)) + kTiltSlack;
  const double limit = std::max(around_.max_object_tilt, at_ends);
  JointPathQuery query{
      from, std::move(goals), around_.fixtures, phase == Phase::approach ? avoided_with_object_ : avoided_, {}};
  if (held && limit < std::numbers::pi) {
    query.accept = [this, limit](const Eigen::VectorXd& q) { return tilt(q) <= limit; };
    query.accept_step = kAcceptStep;
  }
  return find_joint_path(around_.problem.robot, checker_, query, random, options, stop);
}

}  // namespace mamo::retrieval
