#include "mamo/push/push_planner.hpp"

#include <algorithm>

#include "push/push_bodies.hpp"
#include "push/push_sampler.hpp"
#include "push/tip_follower.hpp"
#include "push/way_home.hpp"

#include "mamo/common/cpu_time.hpp"
#include "mamo/common/random.hpp"

namespace mamo {
namespace {

using namespace push;

constexpr std::uint64_t kStreamKey = 0x70757368;  // "push"
constexpr int kDraws = 12;                        // starts drawn in one attempt
constexpr int kPostures = 2;                      // arm postures tried for one start
constexpr double kWayStep = 0.02;                 // m of the tip between two configurations of a push
constexpr double kAngleWeight = 0.1;              // m per rad: how much the gripper's orientation counts in a push

/// A draw that survived all tests but physics.
struct Draw {
  std::vector<Eigen::VectorXd> forward;  // the push itself
  RandomStream random;
};

class StageClock {
 public:
  explicit StageClock(double& sum) : sum_(sum), begin_(thread_cpu_s()) {}
  ~StageClock() { sum_ += thread_cpu_s() - begin_; }

 private:
  double& sum_;
  double begin_;
};

}  // namespace

struct PushPlanner::Impl {
  const Problem& problem;
  const std::shared_ptr<const ForwardKinematics> kinematics;
  const PushOptions options;
  const std::uint64_t seed;
  const PushBodies bodies;
  const PushSampler sampler;
  const InverseKinematics inverse;
  CollisionChecker checker;
  Evaluator evaluator;
  TipFollower follower;
  WayHome home;
  CollisionReport report;

  Impl(const Problem& p, std::shared_ptr<const ForwardKinematics> k, const PushOptions& o, std::uint64_t s)
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

  static bool stopped(StopSource* stop, const std::atomic<bool>* cancel) {
    return (stop && stop->stopped()) || (cancel && cancel->load(std::memory_order_relaxed));
  }

  /// Postures of the arm at the start of the way that touch nothing.
  std::vector<Eigen::VectorXd> starts(const PushRequest& request, const TipWay& way, RandomStream& random,
                                      PushFailure& failure) {
    if (sampler.start_inside(way, request.state, bodies.all) ||
        sampler.gripper().surely_hits(problem.scene, request.state, bodies.all, way.X_WT)) {
      failure = PushFailure::start_in_obstacle;
      return {};
    }
    failure = PushFailure::start_unreachable;
    IkOptions ik;
    ik.starts = 6;
    return inverse.solve_many(way.X_WT, problem.q_start, random.next(), kPostures, ik, [&](const Eigen::VectorXd& q) {
      failure = std::max(failure, PushFailure::start_in_collision);
      return home.free(q, q);
    });
  }

  /// The joint path of the push from q. Empty: see failure.
  std::vector<Eigen::VectorXd> follow(const PushRequest& request, const TipWay& way, const Eigen::VectorXd& q,
                                      PushFailure& failure) {
    std::vector<Eigen::VectorXd> path = {q};
    Eigen::Isometry3d target = way.X_WT;
    for (std::size_t k = 1; k < way.points.size(); ++k) {
      const Eigen::Vector3d step = way.points[k] - way.points[k - 1];
      const int pieces = std::max(1, static_cast<int>(std::ceil(step.norm() / kWayStep)));
      for (int i = 1; i <= pieces; ++i) {
        target.translation() = way.points[k - 1] + step * (static_cast<double>(i) / pieces);
        Eigen::VectorXd next = path.back();
        const Follow result = follower.step(target, kAngleWeight, next);
        if (result != Follow::reached) {
          failure = result == Follow::joint_limit ? PushFailure::joint_limit : PushFailure::path_unreachable;
          return {};
        }
        path.push_back(next);
      }
    }
    ObjectSet watched = bodies.standing;
    watched.insert(request.object);
    bool touches = false;
    for (std::size_t k = 1; k < path.size(); ++k) {
      bool hit = !checker.check_edge(path[k - 1], path[k], bodies.forbidden, watched, report);
      for (const ObjectId id : report.touched) {
        if (id == request.object) touches = true;
        else hit = true;
      }
      if (hit) {
        failure = PushFailure::path_in_collision;
        return {};
      }
    }
    if (touches) return path;
    failure = PushFailure::misses_object;
    return {};
  }

  Evaluation simulate(const PushRequest& request, const std::vector<Eigen::VectorXd>& path, StopSource* stop,
                      const std::atomic<bool>* cancel) {
    const TimedPath motion = time_path(problem.robot, path, problem.scene.physics.step);
    EvaluationRequest r;
    r.present = &bodies.all;
    r.from = &request.state;
    r.motion = &motion;
    r.untouchable = bodies.untouchable;
    r.stop = stop;
    r.cancel = cancel;
    return evaluator.evaluate(r);
  }

  /// Out again: back along the push, and home. Fills what follows the push; false sets the failure.
  bool finish(const PushRequest& request, const Draw& draw, PushOutcome& out, StopSource* stop,
              const std::atomic<bool>* cancel) {
    out.push = draw.forward;
    out.push.insert(out.push.end(), draw.forward.rbegin() + 1, draw.forward.rend());
    Evaluation evaluation;
    {
      const StageClock clock(out.times.simulation);
      evaluation = simulate(request, out.push, stop, cancel);
      ++out.simulations;
    }
    if (evaluation.cancelled) return out.failure = PushFailure::stopped, false;
    out.violation = evaluation.violation;
    if (evaluation.violation) return out.failure = PushFailure::violation, false;
    out.after = std::move(evaluation.state);
    out.settle_s = evaluation.settle_s;
    note_moved(request, out);
    if (!moved_enough(request, out)) return out.failure = PushFailure::nothing_moved, false;
    return true;
  }

  void note_moved(const PushRequest& request, PushOutcome& out) const {
    out.moved.clear();
    for (const ObjectId id : bodies.all.ids())
      if (request.state[id] != out.after[id]) out.moved.push_back(id);
  }
  bool moved_enough(const PushRequest& request, const PushOutcome& out) const {
    return std::any_of(out.moved.begin(), out.moved.end(), [&](ObjectId id) {
      return (out.after.X_WO(id).translation() - request.state.X_WO(id).translation()).norm() >
             options.least_displacement;
    });
  }

  bool retreat(PushOutcome& out, RandomStream random, StopSource* stop) {
    const StageClock clock(out.times.retreat);
    checker.set_state(out.after);
    out.retreat.assign(out.approach.rbegin(), out.approach.rend());
    if (home.free(out.retreat)) return true;
    out.retreat = home.quick(out.push.back());
    if (out.retreat.empty()) out.retreat = home.search(out.push.back(), random, options.approach_nodes, stop);
    return !out.retreat.empty();
  }

  PushOutcome attempt(const PushRequest& request, StopSource* stop, const std::atomic<bool>* cancel) {
    PushOutcome out;
    if (request.path.size() < 2) {
      out.failure = PushFailure::misses_object;
      return out;
    }
    RandomStream random(seed, {kStreamKey, request.stream, static_cast<std::uint64_t>(request.object.value),
                               static_cast<std::uint64_t>(request.attempt)});
    checker.set_state(request.state);
    PushFailure furthest = PushFailure::start_in_obstacle;
    std::vector<Draw> blocked;  // draws without a quick approach
    for (int k = 0; k < kDraws; ++k) {
      if (stopped(stop, cancel)) return out;
      RandomStream own(random.next(), {});
      const TipWay way = sampler.sample(request, own);
      PushFailure failure{};
      std::vector<Eigen::VectorXd> found;
      {
        const StageClock clock(out.times.start);
        found = starts(request, way, own, failure);
      }
      if (found.empty()) furthest = std::max(furthest, failure);
      for (const Eigen::VectorXd& q : found) {
        Draw draw{{}, own};
        {
          const StageClock clock(out.times.way);
          draw.forward = follow(request, way, q, failure);
        }
        if (draw.forward.empty()) {
          furthest = std::max(furthest, failure);
          continue;
        }
        {
          const StageClock clock(out.times.approach);
          out.approach = home.quick(q);
        }
        if (out.approach.empty()) {
          blocked.push_back(std::move(draw));
          continue;
        }
        std::reverse(out.approach.begin(), out.approach.end());
        if (!finish(request, draw, out, stop, cancel)) return out;
        out.failure = retreat(out, own, stop) ? PushFailure::none : PushFailure::no_retreat;
        return out;
      }
    }
    out.failure = furthest;
    if (blocked.empty()) return out;
    // No draw had a cheap approach: physics first, it is cheaper than the search.
    const Draw& draw = blocked.front();
    if (!finish(request, draw, out, stop, cancel)) return out;
    {
      const StageClock clock(out.times.approach);
      checker.set_state(request.state);
      out.approach = home.search(draw.forward.front(), draw.random, options.approach_nodes, stop);
    }
    if (stopped(stop, cancel)) return out.failure = PushFailure::stopped, out;
    if (out.approach.empty()) return out.failure = PushFailure::no_approach, out;
    std::reverse(out.approach.begin(), out.approach.end());
    out.failure = retreat(out, draw.random, stop) ? PushFailure::none : PushFailure::no_retreat;
    return out;
  }
};

PushPlanner::PushPlanner(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                         const PushOptions& options, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(problem, std::move(kinematics), options, seed)) {}
PushPlanner::~PushPlanner() = default;

PushOutcome PushPlanner::attempt(const PushRequest& request, StopSource* stop, const std::atomic<bool>* cancel) {
  const std::int64_t checks = impl_->checker.checks();
  const double simulated = impl_->evaluator.simulation_s();
  PushOutcome out = impl_->attempt(request, stop, cancel);
  out.collision_checks = impl_->checker.checks() - checks;
  out.simulation_s = impl_->evaluator.simulation_s() - simulated;
  return out;
}

bool PushPlanner::reusable(const PushOutcome& stored, const WorldState& state, const ObjectSet& others) {
  CollisionChecker& checker = impl_->checker;
  checker.set_state(state);
  const ObjectSet nothing(impl_->problem.scene.size());
  for (const auto* path : {&stored.push, &stored.approach, &stored.retreat})
    for (std::size_t k = 1; k < path->size(); ++k)
      if (!checker.check_edge((*path)[k - 1], (*path)[k], nothing, others, impl_->report) ||
          !impl_->report.touched.empty())
        return false;
  WorldState after = state;
  for (const ObjectId id : stored.moved) after[id] = stored.after[id];
  checker.set_state(after);
  for (const auto& [a, b] : checker.overlapping_objects(0)) {
    const auto moved = [&](ObjectId id) {
      return std::find(stored.moved.begin(), stored.moved.end(), id) != stored.moved.end();
    };
    if ((moved(a) && others.contains(b)) || (moved(b) && others.contains(a))) return false;
  }
  return true;
}

CollisionChecker& PushPlanner::collision() { return impl_->checker; }
std::int64_t PushPlanner::simulations() const { return impl_->evaluator.simulations(); }
double PushPlanner::simulation_s() const { return impl_->evaluator.simulation_s(); }

}  // namespace mamo
