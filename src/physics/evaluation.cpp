#include "mamo/physics/evaluation.hpp"

#include <time.h>

#include <cmath>
#include <stdexcept>

#include "physics/constraint_watch.hpp"
#include "physics/interaction_log.hpp"

namespace mamo {
namespace {

constexpr int kStepsBetweenPolls = 8;  // of stop and cancel: well under a millisecond

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Counts, per object, for how many steps it has been at rest.
class RestWatch {
 public:
  explicit RestWatch(double step_s) : needed_(static_cast<int>(std::ceil(kRestTime / step_s - 1e-9))) {}

  void begin(const World& world, ObjectId held) {
    ids_ = world.present().ids();
    std::erase(ids_, held);
    steps_.assign(ids_.size(), needed_);
  }
  void note(const World& world) {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (!world.awake(ids_[i]))
        steps_[i] = needed_;
      else
        steps_[i] = speed(world, ids_[i]) < kRestSpeed ? steps_[i] + 1 : 0;
    }
  }
  bool all_rest() const {
    return std::all_of(steps_.begin(), steps_.end(), [this](int s) { return s >= needed_; });
  }
  /// Of those not at rest, or of those awake, the fastest.
  Violation fastest(const World& world, bool of_awake) const {
    Violation v{ViolationKind::not_at_rest, kNoObject, kNoObject, -1, kRestSpeed, 0};
    for (std::size_t i = 0; i < ids_.size(); ++i)
      if ((of_awake ? world.awake(ids_[i]) : steps_[i] < needed_) && speed(world, ids_[i]) > v.value)
        v.object = ids_[i], v.value = speed(world, ids_[i]);
    return v;
  }

 private:
  /// m/s; turning counts in proportion to its own limit.
  static double speed(const World& world, ObjectId id) {
    return std::max(world.linear_velocity(id).norm(),
                    world.angular_velocity(id).norm() * (kRestSpeed / kRestAngularSpeed));
  }
  int needed_;
  std::vector<ObjectId> ids_;
  std::vector<int> steps_;
};

}  // namespace

struct Evaluator::Impl {
  Scene scene;
  World world;
  ConstraintWatch watch;
  InteractionLog log;
  RestWatch rest;
  std::vector<Contact> contacts;
  std::int64_t simulations = 0;
  double simulation_s = 0;

  Impl(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& s)
      : scene(s),
        world(std::move(kinematics), scene),
        watch(scene, world.touching(WorldState::start_of(scene), kTouchDistance)),
        log(scene),
        rest(scene.physics.step) {}

  void begin(const EvaluationRequest& r) {
    std::set<ObjectId> under_held;
    if (r.held.valid())
      for (const auto& [a, b] : world.touching(*r.from, kTouchDistance)) {
        if (a == r.held) under_held.insert(b);
        if (b == r.held) under_held.insert(a);
      }
    world.reset(*r.present, *r.from, r.motion->q.front());
    if (r.held.valid()) world.attach(r.held, r.held_link);
    if (r.grasped.valid() && r.present->contains(r.grasped)) world.ignore_robot(r.grasped);
    watch.begin(r, std::move(under_held));
    log.begin(*r.from);
    rest.begin(world, r.held);
  }

  /// False ends the evaluation.
  bool step(const EvaluationRequest& r, const Eigen::VectorXd& q, Evaluation& out) {
    if (out.steps % kStepsBetweenPolls == 0) {
      out.cancelled = (r.stop && r.stop->stopped()) || (r.cancel && r.cancel->load(std::memory_order_relaxed));
      if (out.cancelled) return false;
    }
    world.step(q);
    ++out.steps;
    world.contacts(contacts);
    log.note(world, contacts, world.time_s());
    rest.note(world);
    out.violation = watch.check(world, contacts);
    return !out.violation;
  }

  void run(const EvaluationRequest& r, Evaluation& out) {
    const double step_s = scene.physics.step;
    const long steps = std::lround(r.motion->duration() / step_s);
    Eigen::VectorXd q;
    for (long k = 1; k <= steps; ++k) {
      r.motion->at(k == steps ? r.motion->duration() : static_cast<double>(k) * step_s, q);
      if (!step(r, q, out)) return;
    }
    const long most = std::lround(scene.physics.settle_time / step_s);
    long waited = 0;
    for (; waited < most && !waited_enough(r); ++waited)
      if (!step(r, r.motion->q.back(), out)) return;
    out.settle_s = static_cast<double>(waited) * step_s;
    if (!waited_enough(r)) out.violation = rest.fastest(world, r.until_asleep);
  }

  bool waited_enough(const EvaluationRequest& r) const {
    if (!r.until_asleep) return rest.all_rest();
    const std::vector<ObjectId> ids = r.present->ids();
    return std::none_of(ids.begin(), ids.end(), [&](ObjectId id) { return id != r.held && world.awake(id); });
  }

  /// An object that was only near what happened may tremble while it is awake: that is no motion.
  bool moved(const EvaluationRequest& r, ObjectId id) const {
    return (world.X_WO(id).translation() - r.from->X_WO(id).translation()).norm() > kTouchDistance;
  }

  Evaluation evaluate(const EvaluationRequest& r) {
    if (!r.present || !r.from || !r.motion || r.motion->q.empty() || r.from->poses.size() != scene.size())
      throw std::invalid_argument("Evaluator: present, from and motion must be given and fit the scene");
    Evaluation out;
    out.state = *r.from;
    begin(r);
    run(r, out);
    if (out.violation) out.violation->time_s = world.time_s();
    out.valid = !out.cancelled && !out.violation;
    out.interactions = log.interactions();
    out.took_part = world.took_part();
    out.swept = world.swept();
    for (const Interaction& i : out.interactions) out.second_order = out.second_order || i.a.valid();
    for (const ObjectId id : r.present->ids()) {
      if (id != r.held && !world.awake(id))
        out.state[id] = world.rest_pose(id);
      else if (id == r.held || r.until_asleep || log.influenced(id) || moved(r, id))
        out.state[id] = quantise(world.X_WO(id));
    }
    return out;
  }
};

Evaluator::Evaluator(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene)
    : impl_(std::make_unique<Impl>(std::move(kinematics), scene)) {}
Evaluator::~Evaluator() = default;

Evaluation Evaluator::evaluate(const EvaluationRequest& request) {
  const double begin = thread_cpu_s();
  Evaluation out = impl_->evaluate(request);
  ++impl_->simulations;
  impl_->simulation_s += thread_cpu_s() - begin;
  return out;
}

const World& Evaluator::world() const { return impl_->world; }
std::int64_t Evaluator::simulations() const { return impl_->simulations; }
double Evaluator::simulation_s() const { return impl_->simulation_s; }

}  // namespace mamo
