#include "mamo/lattice/manipulation_lattice.hpp"

#include <numbers>

#include "mamo/common/hash.hpp"

namespace mamo {
namespace {

/// All shapes are spheres and cylinders around the object's z axis: spinning about it changes nothing.
bool spins_freely(const Object& object) {
  for (const PlacedShape& s : object.shapes) {
    const bool on_axis = s.X_BS.translation().head<2>().norm() < 1e-9;
    const bool upright = std::abs(s.X_BS.linear()(2, 2)) > 1 - 1e-12;
    if (std::holds_alternative<Sphere>(s.shape) && on_axis) continue;
    if (std::holds_alternative<Cylinder>(s.shape) && on_axis && upright) continue;
    return false;
  }
  return true;
}

std::uint64_t hash_configuration(const LatticeState& s) {
  HashStream h;
  h.add(s.anchor);
  for (std::int32_t b : s.bins) h.add(b);
  return h.value();
}

}  // namespace

std::int32_t failure_tag(ViolationKind kind, bool simulated) {
  return 1 + 2 * static_cast<std::int32_t>(kind) + simulated;
}

std::string failure_name(std::int32_t tag) {
  const auto kind = static_cast<ViolationKind>((tag - 1) / 2);
  return std::string((tag - 1) % 2 ? "simulation_" : "collision_") + std::string(to_string(kind));
}

ManipulationLattice::ManipulationLattice(const Problem& problem, const LatticeModel& model,
                                         const RelevantBodies& bodies, const std::set<BannedEdge>& banned,
                                         StopSource* stop, std::shared_ptr<OutcomeMemo> memo)
    : problem_(problem),
      model_(model),
      bodies_(bodies),
      start_(WorldState::start_of(problem.scene)),
      banned_(banned),
      memo_(std::move(memo)),
      stop_(stop) {
  for (ObjectId id : bodies.relevant.ids()) {
    const Object& object = problem.scene[id];
    if (!object.movable() && object.constraints.touch == Touch::forbidden) continue;  // stays: no part of the state
    ids_.push_back(id);
    symmetric_.push_back(spins_freely(object));
  }
}

LatticeState ManipulationLattice::start() const {
  LatticeState s;
  s.bins.assign(static_cast<std::size_t>(problem_.robot.dof()), 0);
  for (ObjectId id : ids_) s.objects.push_back(start_[id]);
  return s;
}

std::uint64_t ManipulationLattice::hash(const State& s) const {
  HashStream h;
  h.add(hash_configuration(s));
  for (const QuantisedPose& pose : s.objects) {
    for (std::int32_t v : pose.p) h.add(v);
    for (std::int32_t v : pose.q) h.add(v);
  }
  return h.value();
}

ManipulationLattice::PoseClass ManipulationLattice::pose_class(std::size_t k, const QuantisedPose& pose) const {
  const LatticeOptions& o = model_.options();
  const Eigen::Isometry3d X = dequantise(pose);
  const double angle = o.object_angle_resolution_deg * std::numbers::pi / 180.0;
  PoseClass c{};
  for (int i = 0; i < 3; ++i) {
    c[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::lround(X.translation()[i] / o.object_position_resolution));
    c[static_cast<std::size_t>(3 + i)] = static_cast<std::int32_t>(std::lround(X.linear()(i, 2) / angle));
    if (!symmetric_[k])
      c[static_cast<std::size_t>(6 + i)] = static_cast<std::int32_t>(std::lround(X.linear()(i, 0) / angle));
  }
  return c;
}

std::uint64_t ManipulationLattice::class_hash(const State& s) const {
  if (model_.options().exact_objects) return hash(s);
  HashStream h;
  h.add(hash_configuration(s));
  for (std::size_t k = 0; k < s.objects.size(); ++k)
    for (std::int32_t v : pose_class(k, s.objects[k])) h.add(v);
  return h.value();
}

bool ManipulationLattice::same_class(const State& a, const State& b) const {
  if (a.anchor != b.anchor || a.bins != b.bins || a.objects.size() != b.objects.size()) return false;
  if (a.objects == b.objects) return true;
  if (model_.options().exact_objects) return false;
  for (std::size_t k = 0; k < a.objects.size(); ++k)
    if (pose_class(k, a.objects[k]) != pose_class(k, b.objects[k])) return false;
  return true;
}

bool ManipulationLattice::is_goal(const State& s) const {
  if (s.anchor != 0) return true;  // snaps end in goals only
  return reaches(model_.goal(), model_.kinematics(), model_.configuration(s.anchor, s.bins));
}

search::Cost ManipulationLattice::heuristic(const State& s) const {
  return is_goal(s) ? 0 : model_.heuristic(model_.configuration(s.anchor, s.bins));
}

void ManipulationLattice::successors(Context& context, const State& s, std::vector<search::LazyEdge>& out) const {
  out.clear();
  model_.moves(s, context.moves);
  const auto contact_cost = static_cast<search::Cost>(std::ceil(1000.0 * model_.options().contact_cost));
  for (const LatticeModel::Move& m : context.moves) {
    const search::Cost h = m.anchor != 0 ? 0 : model_.heuristic(model_.configuration(m.anchor, m.bins));
    out.push_back({m.action, m.cost, h});
    if (contact_cost > 0) out.push_back({m.action | kContactForm, m.cost + contact_cost, h});
  }
}

WorldState ManipulationLattice::world_of(const State& s) const {
  WorldState world = start_;
  for (std::size_t k = 0; k < ids_.size(); ++k) world[ids_[k]] = s.objects[k];
  return world;
}

ManipulationLattice::Seen ManipulationLattice::look(Context& context, const State& s, std::int32_t action,
                                                    const std::vector<Eigen::VectorXd>& legs) const {
  const Edge edge{s, action & ~kContactForm};
  {
    const std::lock_guard lock(notes_->mutex);
    if (const auto it = notes_->seen.find(edge); it != notes_->seen.end()) return it->second;
  }
  Seen seen;
  const std::int64_t checks = context.evaluator->collision_checks();
  const WorldState world = world_of(s);
  Eigen::VectorXd from = model_.configuration(s.anchor, s.bins);
  std::optional<Violation> violation;
  for (; seen.leg < legs.size() && seen.glance == Glance::free; from = legs[seen.leg++])
    if (seen.glance = context.evaluator->glance(from, legs[seen.leg], bodies_, world, violation);
        seen.glance != Glance::free)
      break;
  if (violation) seen.tag = failure_tag(violation->kind, false);
  seen.checks = context.evaluator->collision_checks() - checks;
  const std::lock_guard lock(notes_->mutex);
  notes_->seen.emplace(edge, seen);
  return seen;
}

void ManipulationLattice::simulate(Context& context, const State& s, std::int32_t action,
                                   const std::vector<Eigen::VectorXd>& legs, std::size_t first,
                                   const std::atomic<bool>* cancel, search::EdgeOutcome<State>& outcome,
                                   WorldState& world) const {
  const std::int64_t checks = context.evaluator->collision_checks();
  const double simulated_s = context.evaluator->simulation_s();
  std::vector<Use> uses;
  outcome.valid = true;
  for (std::size_t leg = first; leg < legs.size() && outcome.valid; ++leg) {
    const Eigen::VectorXd from = leg > 0 ? legs[leg - 1] : model_.configuration(s.anchor, s.bins);
    EdgeResult result = context.evaluator->evaluate(from, legs[leg], bodies_, world, stop_, cancel);
    outcome.cancelled = result.cancelled;
    outcome.valid = result.valid;
    outcome.charge += result.simulated;
    if (result.violation) outcome.tag = failure_tag(result.violation->kind, result.simulated);
    if (memo_ && result.motion_simulated) uses.push_back({result.motion_simulated, world});
    if (outcome.valid) world = std::move(result.state);
  }
  outcome.work += context.evaluator->collision_checks() - checks;
  outcome.costly_us = static_cast<float>(1e6 * (context.evaluator->simulation_s() - simulated_s));
  if (uses.empty() || outcome.cancelled) return;
  const std::lock_guard lock(notes_->mutex);
  notes_->uses[{s, action}] = std::move(uses);
}

search::EdgeOutcome<LatticeState> ManipulationLattice::evaluate(Context& context, const State& s, std::int32_t action,
                                                                const std::atomic<bool>* cancel) const {
  search::EdgeOutcome<State> outcome;
  LatticeModel::Move m;
  if (!model_.move(s, action, m) || (!banned_.empty() && banned_.contains({s, action}))) return outcome;
  const std::vector<Eigen::VectorXd> legs = model_.legs(s, action);
  WorldState world = world_of(s);
  if (model_.options().contact_cost <= 0) {
    simulate(context, s, action, legs, 0, cancel, outcome, world);
  } else {
    const Seen seen = look(context, s, action, legs);
    if (action < kContactForm) {
      outcome.valid = seen.glance == Glance::free;
      outcome.tag = seen.tag;
      outcome.work = seen.checks;
    } else if (seen.glance == Glance::touching) {
      simulate(context, s, action, legs, seen.leg, cancel, outcome, world);
    }
  }
  if (!outcome.valid) return outcome;
  outcome.child.anchor = m.anchor;
  outcome.child.bins = std::move(m.bins);
  for (ObjectId id : ids_) outcome.child.objects.push_back(world[id]);
  return outcome;
}

std::int32_t ManipulationLattice::on_commit(const State& s, std::int32_t action,
                                            const search::EdgeReport& report) const {
  if (!memo_ || report.charge == 0) return report.charge;
  std::vector<Use> uses;
  {
    const std::lock_guard lock(notes_->mutex);
    if (auto node = notes_->uses.extract({s, action})) uses = std::move(node.mapped());
  }
  std::int32_t charge = 0;
  for (const Use& use : uses) charge += memo_->charged(*use.motion, bodies_.relevant, use.from);
  return charge;
}

}  // namespace mamo
