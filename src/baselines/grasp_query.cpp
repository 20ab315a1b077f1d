#include "baselines/grasp_query.hpp"

#include <cmath>

namespace mamo {

void GraspOptions::add_to(OptionTable& t) {
  t.add("ways", ways, 1, 1000, "grasps to choose from, each with a way home that is free but for movable objects");
  t.add("grasps", retrieval.grasps, 1, 10000, "grasp poses drawn around the given pre-grasp");
  t.add("grasp_solutions", retrieval.solutions, 1, 100, "inverse-kinematics solutions per grasp pose");
  t.add("lift", retrieval.lift, 0.0, 1.0, "height by which the object is lifted before it is drawn out (m)");
  t.add("max_object_tilt_deg", retrieval.max_object_tilt_deg, 0.0, 180.0, "tilt of the held object on the way home");
  t.add("retrieval_nodes", retrieval.max_nodes, 1, 10'000'000, "tree nodes of each search of a retrieval");
}

GraspQuery::GraspQuery(std::string planner, const Problem& problem, const PlanOptions& options,
                       const PlanContext& context, const GraspOptions& settings)
    : problem_(problem),
      options_(options),
      context_(context),
      settings_(settings),
      target_(std::get<Retrieve>(problem.task).object),
      reach_(problem) {
  reach_.scene.objects[target_.index()].constraints.touch = Touch::forbidden;
  result_.planner = std::move(planner);
  result_.seed = options.seed;
  result_.threads = options.threads;
}

void GraspQuery::prepare() {
  kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
  reach_.task = ReachJoints{problem_.q_start};
  evaluator_ = std::make_unique<EdgeEvaluator>(reach_, kinematics_, CollisionOptions{});
  physics_ = std::make_unique<Evaluator>(kinematics_, problem_.scene);
  everything_ = make_relevant_bodies(reach_, ObjectSet::all(reach_.scene));
  const RetrievalPlanner planner(problem_, kinematics_, settings_.retrieval, options_.seed, checker());
  const ObjectSet nobody(problem_.scene.size());
  ObjectSet movables = ObjectSet::of_kind(problem_.scene, ObjectKind::movable);
  movables.erase(target_);
  const WorldState start = WorldState::start_of(problem_.scene);
  std::map<std::string, std::int64_t> failures = planner.rejected();
  bool exhausted = true;
  for (const auto& [grasp, objects] : planner.least_obstructed(checker(), start, movables, settings_.ways)) {
    RetrievalOutcome outcome = planner.plan(checker(), start, nobody, grasp, context_.stop);
    if (outcome.stopped) return stopped();
    if (outcome.path) ways_.push_back(*std::move(outcome.path));
    exhausted = exhausted && outcome.exhausted;
    for (const auto& [cause, number] : outcome.failures) failures[cause] += number;
  }
  if (!ways_.empty()) return;
  std::string causes;
  for (const auto& [cause, number] : failures) {
    result_.stats.failures["retrieval_" + cause] += number;
    causes += (causes.empty() ? "" : ", ") + cause + " " + std::to_string(number);
  }
  finish(exhausted ? PlanStatus::proven : PlanStatus::limit,
         "no way to grasp " + problem_.scene[target_].id + " and bring it home even without the movable objects (" +
             causes + "), given the grasps drawn (grasps, grasp_solutions)");
}

PlanResult GraspQuery::run() {
  prepare();
  if (!over_) search();
  PlanStats& stats = result_.stats;
  stats.simulations += evaluator_->simulations() + physics_->simulations() - tracked_;
  stats.simulation_s += evaluator_->simulation_s() + physics_->simulation_s();
  stats.collision_checks += evaluator_->collision_checks();
  stats.wall_s = watch_.seconds();
  stats.search_s = stats.wall_s - stats.verification_s;
  for (const Segment& segment : result_.plan.segments)
    for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
      signature_.add(segment.motion.t[k]);
      for (Eigen::Index i = 0; i < segment.motion.q[k].size(); ++i) signature_.add(segment.motion.q[k][i]);
    }
  signature_.add(stats.simulations_used);
  result_.signature = signature_.value();
  return std::move(result_);
}

EdgeResult GraspQuery::step(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from) {
  EdgeResult edge = evaluator_->evaluate(q0, q1, everything_, from, context_.stop, nullptr);
  result_.stats.simulations_used += edge.simulated;
  if (edge.violation)
    ++result_.stats
          .failures[(edge.simulated ? "simulation_" : "collision_") + std::string(to_string(edge.violation->kind))];
  return edge;
}

GraspQuery::Leg GraspQuery::simulate(EvaluationRequest request, const std::vector<Eigen::VectorXd>& path,
                                     const WorldState& from) {
  Leg leg;
  leg.motion = time_path(problem_.robot, path, problem_.scene.physics.step);
  request.present = &everything_.relevant;
  request.from = &from;
  request.motion = &leg.motion;
  request.until_asleep = true;
  request.stop = context_.stop;
  Evaluation evaluation = physics_->evaluate(request);
  ++result_.stats.simulations_used;
  leg.stopped = evaluation.cancelled;
  leg.valid = evaluation.valid && !evaluation.cancelled;
  leg.violation = evaluation.violation;
  leg.after = std::move(evaluation.state);
  const double step_s = problem_.scene.physics.step;
  const long wait = std::lround(evaluation.settle_s / step_s);
  if (leg.valid && wait > 0) {
    leg.motion.t.push_back(static_cast<double>(std::lround(leg.motion.t.back() / step_s) + wait) * step_s);
    leg.motion.q.push_back(leg.motion.q.back());
  }
  if (leg.violation) ++result_.stats.failures["fetching_" + std::string(to_string(leg.violation->kind))];
  return leg;
}

GraspQuery::Leg GraspQuery::reach(const RetrievalPath& way, const WorldState& from) {
  EvaluationRequest request;
  request.untouchable = target_;
  request.grasped = target_;
  return simulate(request, way.reach, from);
}

GraspQuery::Leg GraspQuery::extract(const RetrievalPath& way, const WorldState& from) {
  EvaluationRequest request;
  request.held = target_;
  request.held_link = problem_.robot.group.tip;
  return simulate(request, way.extract, from);
}

bool GraspQuery::completes(const Eigen::VectorXd& q, const WorldState& from, const RetrievalPath& way) {
  WorldState state = from;
  if (q != way.reach.front()) {
    EdgeResult edge = step(q, way.reach.front(), state);
    if (!edge.valid) return false;
    state = std::move(edge.state);
  }
  const Leg closed = reach(way, state);
  return closed.valid && extract(way, closed.after).valid;
}

void GraspQuery::add_segment(SegmentKind kind, const TimedPath& motion) {
  Segment segment;
  segment.kind = kind;
  segment.object = target_;
  for (int i = 0; i < problem_.robot.dof(); ++i) segment.joint_names.push_back(problem_.robot.joint(i).name);
  segment.motion = motion;
  result_.plan.segments.push_back(std::move(segment));
}

GraspQuery::Submitted GraspQuery::submit(std::vector<Eigen::VectorXd> path, const RetrievalPath& way) {
  if (path.back() != way.reach.front()) path.push_back(way.reach.front());
  const Track approach = track(reach_, *evaluator_, path, everything_, context_.stop);
  tracked_ += approach.simulations;
  result_.stats.tracking_simulations += approach.simulations;
  if (approach.stopped) return stopped(), Submitted::ended;
  if (!approach.ok) {
    ++result_.stats.failures["replay_mismatch"];
    return Submitted::rejected;
  }
  const Leg closed = reach(way, approach.state);
  const Leg fetched = closed.valid ? extract(way, closed.after) : Leg{};
  if (closed.stopped || fetched.stopped) return stopped(), Submitted::ended;
  if (!fetched.valid) return Submitted::rejected;
  if (out_of_simulations()) return Submitted::ended;
  result_.second_order_contacts = approach.second_order;
  result_.plan = {};
  add_segment(SegmentKind::approach, approach.motion);
  add_segment(SegmentKind::grasp, closed.motion);
  add_segment(SegmentKind::extract, fetched.motion);
  return judge();
}

GraspQuery::Submitted GraspQuery::judge() {
  if (!result_.found) result_.stats.found_s = watch_.seconds();
  result_.found = true;
  if (!context_.judge) return finish(PlanStatus::solved, ""), Submitted::accepted;
  const Stopwatch watch;
  const Verdict verdict = context_.judge->judge(problem_, result_.plan, *context_.stop);
  result_.stats.verification_s += watch.seconds();
  if (verdict.stopped) return stopped(), Submitted::ended;
  result_.verified = verdict.ok;
  if (!verdict.ok) {
    ++result_.rejected_by_verification;
    ++result_.stats.failures["replay_" + std::string(to_string(verdict.findings.front().violation.kind))];
    return Submitted::rejected;
  }
  for (std::size_t s = 0; s < result_.plan.segments.size(); ++s)
    result_.plan.segments[s].objects_after = verdict.objects_after[s];
  return finish(PlanStatus::solved, ""), Submitted::accepted;
}

bool GraspQuery::out_of_simulations() {
  if (result_.stats.simulations_used <= options_.max_simulations) return false;
  finish(PlanStatus::limit, "no plan within the limit on simulations; --max-simulations raises it");
  return true;
}

void GraspQuery::finish(PlanStatus status, std::string reason) {
  over_ = true;
  result_.status = status;
  result_.reason = std::move(reason);
  if (status != PlanStatus::solved) result_.plan = {};
}

void GraspQuery::stopped() {
  switch (context_.stop->reason()) {
    case StopReason::interrupted:
      return finish(PlanStatus::interrupted, "interrupted");
    case StopReason::memory:
      return finish(PlanStatus::memory, "the memory limit was reached; --memory-limit raises it");
    default:
      return finish(PlanStatus::timeout, "no plan within the time limit; --time-limit raises it");
  }
}

void GraspQuery::report_progress() {
  if (context_.on_progress)
    context_.on_progress({watch_.seconds(), result_.stats.expansions, result_.stats.simulations_used, 0, 0, 1});
}

}  // namespace mamo
