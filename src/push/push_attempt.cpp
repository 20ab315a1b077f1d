#include "push/push_attempt.hpp"

#include <algorithm>
#include <cmath>

#include "mamo/common/cpu_time.hpp"

namespace mamo::push {
namespace {

constexpr std::uint64_t kStreamKey = 0x70757368;  // "push"
constexpr double kWayStep = 0.02;                 // m of the tip between two configurations of a push
constexpr double kAngleWeight = 0.1;              // m per rad: how much the gripper's orientation counts on the way
constexpr int kPostures = 2, kPostureStarts = 6;  // of the arm, for one start: tried on, and drawn
constexpr double kBeforeViolation = 0.3;          // s: where a push ends that would have been a violation
constexpr double kWhole = 1 - 1e-9;               // share of a way that ends where it should

/// Adds the thread's CPU time to a sum; measures only.
class StageClock {
 public:
  explicit StageClock(double& sum) : sum_(sum), begin_(thread_cpu_s()) {}
  ~StageClock() { sum_ += thread_cpu_s() - begin_; }
  StageClock(const StageClock&) = delete;

 private:
  double& sum_;
  double begin_;
};

bool goes_anywhere(const std::vector<Eigen::Vector2d>& path) {
  return std::any_of(path.begin(), path.end(), [&](const auto& p) { return (p - path.front()).norm() > 1e-6; });
}

std::vector<Eigen::VectorXd> there_and_back(const std::vector<Eigen::VectorXd>& way) {
  std::vector<Eigen::VectorXd> path = way;
  path.insert(path.end(), way.rbegin() + 1, way.rend());
  return path;
}

}  // namespace

PushTools::PushTools(const Problem& p, std::shared_ptr<const ForwardKinematics> k, const PushOptions& o,
                     std::uint64_t s)
    : problem(p),
      kinematics(std::move(k)),
      options(o),
      seed(s),
      bodies(push_bodies(p)),
      sampler(p, *kinematics, o),
      inverse(*kinematics),
      checker(kinematics, p.scene),
      evaluator(kinematics, p.scene),
      follower(*kinematics),
      home(p, *kinematics, bodies, checker) {}

PushAttempt::PushAttempt(PushTools& tools, const PushRequest& request, StopSource* stop,
                         const std::atomic<bool>* cancel)
    : tools_(tools),
      request_(request),
      stop_(stop),
      cancel_(cancel),
      random_(tools.seed, {kStreamKey, request.stream, static_cast<std::uint64_t>(request.object.value),
                           static_cast<std::uint64_t>(request.attempt)}) {}

PushOutcome PushAttempt::run() {
  if (!goes_anywhere(request_.path)) {
    out_.failure = PushFailure::misses_object;
    return out_;
  }
  out_.failure = PushFailure::start_in_obstacle;
  tools_.checker.set_state(request_.state);
  const int draws = tools_.options.draws, simulations = tools_.options.simulations;
  for (int k = 0; k < draws && !done_ && out_.simulations < simulations && !stopped(); ++k) try_draw(k);
  // None with a cheap approach: physics first, it costs less than the search.
  if (!done_ && !blocked_.empty() && out_.simulations < simulations) push_first(blocked_.front());
  if (!done_ && !short_.empty()) {
    const auto further = [](const Draw& a, const Draw& b) { return a.way.end() < b.way.end(); };
    push_first(*std::max_element(short_.begin(), short_.end(), further));
  }
  if (stopped()) out_.failure = PushFailure::stopped;
  if (out_.failure != PushFailure::violation) out_.violation.reset();
  if (!out_.valid()) out_.approach.clear(), out_.push.clear(), out_.retreat.clear();
  return std::move(out_);
}

bool PushAttempt::stopped() const {
  return (stop_ && stop_->stopped()) || (cancel_ && cancel_->load(std::memory_order_relaxed));
}

void PushAttempt::failed(PushFailure failure) { out_.failure = std::max(out_.failure, failure); }

void PushAttempt::try_draw(int index) {
  RandomStream own(random_.next(), {});
  const bool common = request_.attempt % 2 == 0 && index < tools_.options.draws / 3;
  const TipWay way = tools_.sampler.sample(request_, common ? Spread::common : Spread::wide, own);
  for (const Eigen::VectorXd& q : starts(way, own)) {
    Draw draw{follow(way, q), own};
    if (draw.way.q.empty()) continue;
    if (draw.way.end() < kWhole) {
      short_.push_back(std::move(draw));
    } else if (!quick_approach(draw)) {
      failed(PushFailure::no_approach);
      blocked_.push_back(std::move(draw));
    } else {
      if (simulate(draw)) retreat(draw);
      return;  // another posture would push the same way
    }
  }
}

/// Postures of the arm at the start of the way that touch nothing.
std::vector<Eigen::VectorXd> PushAttempt::starts(const TipWay& way, RandomStream& random) {
  const StageClock clock(out_.times.start);
  if (tools_.sampler.start_inside(way, request_.state, tools_.bodies.all)) return {};
  failed(PushFailure::start_unreachable);
  IkOptions options;
  options.starts = kPostureStarts;
  return tools_.inverse.solve_many(way.X_WT, tools_.problem.q_start, random.next(), kPostures, options,
                                   [&](const Eigen::VectorXd& q) {
                                     failed(PushFailure::start_in_collision);
                                     return tools_.home.free(q, q);
                                   });
}

/// The joint path of the push from q, as far as it goes; empty when that is not far enough.
JointWay PushAttempt::follow(const TipWay& way, const Eigen::VectorXd& q) {
  const StageClock clock(out_.times.way);
  double length = 0;
  for (std::size_t k = 1; k < way.points.size(); ++k) length += (way.points[k] - way.points[k - 1]).norm();
  const double pushed = std::max(1e-6, length - way.free_length);

  JointWay joints{{q}, {-way.free_length / pushed}};
  PushFailure failure = PushFailure::none;
  Eigen::Isometry3d target = way.X_WT;
  for (std::size_t k = 1; k < way.points.size() && failure == PushFailure::none; ++k) {
    const Eigen::Vector3d step = way.points[k] - way.points[k - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(step.norm() / kWayStep)));
    for (int i = 1; i <= pieces && failure == PushFailure::none; ++i) {
      target.translation() = way.points[k - 1] + step * (static_cast<double>(i) / pieces);
      Eigen::VectorXd next = joints.q.back();
      const Follow result = tools_.follower.step(target, kAngleWeight, next);
      if (result == Follow::joint_limit) failure = PushFailure::joint_limit;
      if (result == Follow::unreachable) failure = PushFailure::path_unreachable;
      if (failure != PushFailure::none) break;
      joints.q.push_back(next);
      joints.share.push_back(joints.share.back() + step.norm() / pieces / pushed);
    }
  }
  if (joints.end() >= kWhole || joints.end() >= tools_.options.least_share) {
    const PushFailure collision = cut_to_free(joints);
    if (collision != PushFailure::none) failure = collision;
  }
  if (failure != PushFailure::none) failed(failure);
  if (failure == PushFailure::misses_object || joints.end() < std::min(tools_.options.least_share, kWhole)) return {};
  return joints;
}

/// Drops what comes after the first edge on which something untouchable is touched. What stays is padded, but for
/// fixtures: the simulator has its own idea of contact.
PushFailure PushAttempt::cut_to_free(JointWay& way) {
  ObjectSet watched = tools_.bodies.standing;
  watched.insert(request_.object);
  CollisionReport& report = tools_.report;
  bool touches = false;
  for (std::size_t k = 1; k < way.q.size(); ++k) {
    bool hit = !tools_.checker.check_edge(way.q[k - 1], way.q[k], tools_.bodies.forbidden, watched, report);
    for (const ObjectId id : report.touched) (id == request_.object ? touches : hit) = true;
    if (!hit) continue;
    way.q.resize(k);
    way.share.resize(k);
    return PushFailure::path_in_collision;
  }
  return touches ? PushFailure::none : PushFailure::misses_object;
}

bool PushAttempt::quick_approach(const Draw& draw) {
  const StageClock clock(out_.times.approach);
  tools_.checker.set_state(request_.state);
  out_.approach = tools_.home.quick(draw.way.q.front());
  std::reverse(out_.approach.begin(), out_.approach.end());
  return !out_.approach.empty();
}

bool PushAttempt::search_approach(const Draw& draw) {
  const StageClock clock(out_.times.approach);
  tools_.checker.set_state(request_.state);
  out_.approach = tools_.home.search(draw.way.q.front(), draw.random, tools_.options.approach_nodes, stop_);
  std::reverse(out_.approach.begin(), out_.approach.end());
  return !out_.approach.empty();
}

/// There and back in physics, from rest to rest with every object. True: nothing is violated and something moved.
bool PushAttempt::simulate(const Draw& draw) {
  const StageClock clock(out_.times.simulation);
  out_.push = there_and_back(draw.way.q);
  out_.share = std::min(1.0, draw.way.end());
  const TimedPath motion = time_path(tools_.problem.robot, out_.push, tools_.problem.scene.physics.step);
  EvaluationRequest request;
  request.present = &tools_.bodies.all;
  request.from = &request_.state;
  request.motion = &motion;
  request.untouchable = tools_.bodies.untouchable;
  request.until_asleep = true;
  request.stop = stop_;
  request.cancel = cancel_;
  Evaluation evaluation = tools_.evaluator.evaluate(request);
  ++out_.simulations;
  if (evaluation.cancelled) {
    done_ = true;
    return false;
  }
  if (evaluation.violation) {
    failed(PushFailure::violation);
    out_.violation = evaluation.violation;
    stop_before(*evaluation.violation, draw);
    return false;
  }
  out_.after = std::move(evaluation.state);
  out_.settle_s = evaluation.settle_s;
  note_moved();
  const bool enough = std::any_of(out_.moved.begin(), out_.moved.end(), [&](ObjectId id) {
    const Eigen::Vector3d moved = out_.after.X_WO(id).translation() - request_.state.X_WO(id).translation();
    return moved.norm() > tools_.options.least_displacement;
  });
  if (!enough) failed(PushFailure::nothing_moved);
  return enough;
}

void PushAttempt::note_moved() {
  out_.moved.clear();
  for (const ObjectId id : tools_.bodies.all.ids())
    if (request_.state[id] != out_.after[id]) out_.moved.push_back(id);
}

/// The same push may hold if it ends a little before the violation.
void PushAttempt::stop_before(const Violation& violation, const Draw& draw) {
  const TimedPath there = time_path(tools_.problem.robot, draw.way.q, tools_.problem.scene.physics.step);
  if (violation.time_s > there.duration() || there.q.size() != draw.way.q.size()) return;
  std::size_t end = 0;
  while (end + 1 < there.t.size() && there.t[end + 1] <= violation.time_s - kBeforeViolation) ++end;
  if (end == 0 || draw.way.share[end] < tools_.options.least_share) return;
  Draw shorter = draw;
  shorter.way.q.resize(end + 1);
  shorter.way.share.resize(end + 1);
  short_.push_back(std::move(shorter));
}

void PushAttempt::push_first(const Draw& draw) {
  const bool approached = quick_approach(draw);
  const std::vector<Eigen::VectorXd> approach = out_.approach;
  if (!simulate(draw)) return;
  if (approached) return retreat(draw);
  if (search_approach(draw)) return retreat(draw);
  failed(PushFailure::no_approach);
}

/// Home by the way it came, or by another.
void PushAttempt::retreat(const Draw& draw) {
  const StageClock clock(out_.times.retreat);
  tools_.checker.set_state(out_.after);
  out_.retreat.assign(out_.approach.rbegin(), out_.approach.rend());
  if (!tools_.home.free(out_.retreat)) out_.retreat = tools_.home.quick(out_.push.back());
  if (out_.retreat.empty())
    out_.retreat = tools_.home.search(out_.push.back(), draw.random, tools_.options.approach_nodes, stop_);
  tools_.checker.set_state(request_.state);
  if (out_.retreat.empty()) return failed(PushFailure::no_retreat);
  out_.failure = PushFailure::none;
  done_ = true;
}

}  // namespace mamo::push
