#include "verify/replay.hpp"

#include <cmath>

#include "verify/constraints.hpp"
#include "verify/interaction_log.hpp"
#include "verify/plan_checks.hpp"
#include "verify/recorder.hpp"

#include "mamo/physics/world.hpp"

namespace mamo::verify {
namespace {

constexpr int kRestSteps = 10;        // steps in a row below the rest speeds: at rest
constexpr double kGraspReach = 0.02;  // m: what a gripper holds is this near to one of its links

class Replay {
 public:
  Replay(const Problem& problem, const Plan& plan, const Timeline& line,
         std::shared_ptr<const ForwardKinematics> kinematics, ArmCheck& arm, Recording* recording)
      : problem_(problem),
        scene_(problem.scene),
        line_(line),
        kinematics_(kinematics),
        arm_(arm),
        world_(kinematics, problem.scene),
        constraints_(problem, *kinematics),
        log_(problem.scene),
        grasp_(grasp_segment(problem, plan)) {
    if (recording) recorder_.emplace(problem.scene, *recording);
    if (const Retrieve* retrieve = std::get_if<Retrieve>(&problem.task)) retrieved_ = retrieve->object;
  }

  ReplayOutcome run(double until_s, StopSource& stop) {
    world_.reset(ObjectSet::all(scene_), WorldState::start_of(scene_), line_.path.q.front());
    q_ = line_.path.q.front();
    if (recorder_) recorder_->note(world_, {}, 0.0, q_);
    begin_and_end_segments(0.0, false);
    const double step_s = scene_.physics.step;
    const long motion_steps = static_cast<long>(std::ceil(line_.duration_s() / step_s - 1e-6));
    const long settle_steps = static_cast<long>(std::ceil(scene_.physics.settle_time / step_s - 1e-6));
    for (long k = 1; !out_.violation && k <= motion_steps + settle_steps; ++k) {
      const double time_s = static_cast<double>(k) * step_s;
      if (time_s > until_s + 1e-9) return finish();
      if (k > motion_steps && resting_steps_ >= kRestSteps) break;
      if (stop.stopped()) {
        out_.stopped = true;
        return finish();
      }
      advance(time_s);
      if (!out_.violation) begin_and_end_segments(time_s, false);
    }
    if (!out_.violation) judge_rest();
    if (!out_.violation) begin_and_end_segments(line_.duration_s(), true);
    return finish();
  }

 private:
  /// One step of the world to the plan's configuration at time_s, and its judgement.
  void advance(double time_s) {
    Eigen::VectorXd q;
    line_.path.at(time_s, q);
    world_.step(q);
    world_.contacts(contacts_);
    std::vector<Contact> counted;
    for (const Contact& c : contacts_) counted.push_back(constraints_.as_robot(c, grip_));
    log_.note(world_, counted, time_s);
    if (recorder_) recorder_->note(world_, counted, time_s, q);
    if (std::optional<Violation> v = constraints_.judge(world_, contacts_, grip_)) report(*v, time_s, {});
    constraints_.track_clearing(contacts_, grip_);
    if (!out_.violation && grip_ == Grip::holding) {
      if (const std::optional<ArmHit> hit = arm_.held_along(q_, q)) {
        Violation v{ViolationKind::robot_touch, hit->body, kRobot, 0, 0, 0};
        report(v, time_s, "the held " + scene_[retrieved_].id + " touches it");
      }
    }
    q_ = q;
    resting_steps_ = all_slow() ? resting_steps_ + 1 : 0;
  }

  bool all_slow() const {
    for (ObjectId id : world_.present().ids()) {
      if (!world_.awake(id) || (grip_ == Grip::holding && id == retrieved_)) continue;
      if (world_.linear_velocity(id).norm() > kRestSpeed || world_.angular_velocity(id).norm() > kRestAngularSpeed)
        return false;
    }
    return true;
  }

  void judge_rest() {
    if (resting_steps_ >= kRestSteps) return;
    Violation fastest{ViolationKind::not_at_rest, kNoObject, kNoObject, 0, kRestSpeed, 0};
    for (ObjectId id : world_.present().ids()) {
      if (!world_.awake(id) || (grip_ == Grip::holding && id == retrieved_)) continue;
      const double speed = world_.linear_velocity(id).norm();
      if (fastest.object != kNoObject && speed <= fastest.value) continue;
      fastest.object = id;
      fastest.value = speed;
    }
    report(fastest, world_.time_s(), "still moving at the settle limit");
  }

  /// Grips and measures at the boundaries passed by time_s. The last segment ends when everything has settled.
  void begin_and_end_segments(double time_s, bool settled) {
    const int count = static_cast<int>(line_.end_s.size());
    for (;;) {
      if (begun_ < count && begun_ == ended_ && line_.begin_s[static_cast<std::size_t>(begun_)] <= time_s + 1e-9) {
        if (begun_ == grasp_) grip_ = Grip::closing, world_.ignore_robot(retrieved_);
        ++begun_;
      } else if (ended_ < begun_ && line_.end_s[static_cast<std::size_t>(ended_)] <= time_s + 1e-9 &&
                 (ended_ + 1 < count || settled)) {
        end_segment(time_s);
        if (out_.violation) return;
      } else {
        // The last segment's grip does not wait for the settling.
        if (ended_ + 1 == count && ended_ == grasp_ && grip_ == Grip::closing && !settled &&
            line_.end_s.back() <= time_s + 1e-9)
          take(time_s);
        return;
      }
    }
  }

  void end_segment(double time_s) {
    if (ended_ == grasp_ && grip_ == Grip::closing) take(time_s);
    std::map<ObjectId, Eigen::Isometry3d> poses;
    for (ObjectId id : world_.present().ids()) poses[id] = world_.X_WO(id);
    out_.objects_after.push_back(std::move(poses));
    ++ended_;
  }

  void take(double time_s) {
    const LinkId tip = problem_.robot.group.tip;
    const Eigen::Isometry3d X_WO = world_.X_WO(retrieved_);
    if (!arm_.reaches(q_, scene_[retrieved_], X_WO, kGraspReach)) {
      Violation v{ViolationKind::task_not_done, retrieved_, kRobot, kGraspReach, kGraspReach, 0};
      return report(v, time_s, "no link is near enough to hold it at the end of the grasp");
    }
    std::set<ObjectId> support;
    for (const auto& [a, b] : constraints_.start_pairs()) {
      if (a == retrieved_) support.insert(b);
      if (b == retrieved_) support.insert(a);
    }
    world_.attach(retrieved_, tip);
    arm_.hold(scene_[retrieved_], tip, kinematics_->link_pose(q_, tip).inverse() * X_WO, std::move(support));
    grip_ = Grip::holding;
    if (recorder_) recorder_->grasped(time_s);
  }

  void report(Violation v, double time_s, std::string detail) {
    v.time_s = time_s;
    out_.violation = v;
    out_.detail = std::move(detail);
    out_.segment = line_.segment_at(time_s);
  }

  ReplayOutcome finish() {
    if (recorder_) recorder_->finish();
    out_.interactions = log_.interactions();
    out_.holding = grip_ == Grip::holding;
    return std::move(out_);
  }

  const Problem& problem_;
  const Scene& scene_;
  const Timeline& line_;
  std::shared_ptr<const ForwardKinematics> kinematics_;
  ArmCheck& arm_;
  World world_;
  Constraints constraints_;
  InteractionLog log_;
  std::optional<Recorder> recorder_;
  const int grasp_;  // segment, -1: none
  ObjectId retrieved_ = kNoObject;
  Grip grip_ = Grip::none;
  Eigen::VectorXd q_;
  std::vector<Contact> contacts_;
  int begun_ = 0, ended_ = 0;  // segments
  int resting_steps_ = 0;
  ReplayOutcome out_;
};

}  // namespace

ReplayOutcome replay(const Problem& problem, const Plan& plan, const Timeline& line,
                     std::shared_ptr<const ForwardKinematics> kinematics, ArmCheck& arm, double until_s,
                     StopSource& stop, Recording* recording) {
  return Replay(problem, plan, line, std::move(kinematics), arm, recording).run(until_s, stop);
}

}  // namespace mamo::verify
