#include "mamo/rearrangement/rearrangement_query.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "mamo/rearrangement/rearrangement_plan.hpp"

namespace mamo {

RearrangementQuery::RearrangementQuery(std::string planner, const Problem& problem, const PlanOptions& options,
                                       const PlanContext& context, const RearrangementOptions& settings)
    : problem_(problem), options_(options), context_(context), settings_(settings) {
  result_.planner = std::move(planner);
  result_.seed = options.seed;
  result_.threads = options.threads;
}

void RearrangementQuery::prepare() {
  target_ = std::get<Retrieve>(problem_.task).object;
  all_movables_ = ObjectSet::of_kind(scene(), ObjectKind::movable);
  all_movables_.erase(target_);
  movables_ = all_movables_.ids();
  kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
  executor_ = std::make_unique<Executor>(std::max(1, options_.threads));
  for (int w = 0; w < executor_->workers(); ++w)
    workers_.push_back(std::make_unique<PushPlanner>(problem_, kinematics_, settings_.push, options_.seed));
  std::vector<CollisionChecker*> checkers;
  for (const auto& worker : workers_) checkers.push_back(&worker->collision());
  retrievals_ = std::make_unique<RetrievalPlanner>(problem_, kinematics_, settings_.retrieval, options_.seed,
                                                   *executor_, checkers);
  path_finder_ = std::make_unique<ObjectPathFinder>(problem_, target_, settings_.paths);
}

PlanResult RearrangementQuery::run() {
  prepare();
  JobBoard::run(*executor_, board_, [this] { search(); });
  for (const auto& worker : workers_) {
    result_.stats.simulation_s += worker->simulation_s();
    result_.stats.simulations += worker->simulations();
  }
  result_.stats.wall_s = watch_.seconds();
  result_.stats.search_s = result_.stats.wall_s - result_.stats.verification_s;
  double length = 0;
  for (const Segment& segment : result_.plan.segments)
    for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
      if (k > 0) length += (segment.motion.q[k] - segment.motion.q[k - 1]).norm();
      signature_.add(segment.motion.t[k]);
      for (Eigen::Index i = 0; i < segment.motion.q[k].size(); ++i) signature_.add(segment.motion.q[k][i]);
    }
  result_.cost = static_cast<std::int64_t>(std::ceil(1000 * length));
  result_.signature = signature_.value();
  return std::move(result_);
}

RearrangementQuery::Submitted RearrangementQuery::submit(const std::vector<Step>& pushes,
                                                         const RetrievalPath& retrieval, Verdict& verdict) {
  if (!result_.found) result_.stats.found_s = watch_.seconds();
  result_.found = true;
  std::vector<std::pair<ObjectId, const PushOutcome*>> steps;
  for (const Step& step : pushes) steps.push_back({step.first, step.second.get()});
  result_.plan = rearrangement_plan(problem_, steps, retrieval);
  if (!context_.judge) return finish(PlanStatus::solved, ""), Submitted::accepted;
  const Stopwatch watch;
  verdict = context_.judge->judge(problem_, result_.plan, stop());
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

RearrangementQuery::Submitted RearrangementQuery::try_retrievals(const std::vector<Step>& pushes,
                                                                 const WorldState& state, RetrievalOutcome outcome,
                                                                 const std::function<bool(const Verdict&)>& learn) {
  for (int rejected = 0;; ++rejected) {
    if (outcome.stopped) return stopped(), Submitted::ended;
    count_failures(outcome.failures, "retrieval_");
    if (!outcome.path) return Submitted::rejected;
    Verdict verdict;
    const Submitted submitted = submit(pushes, *outcome.path, verdict);
    if (submitted != Submitted::rejected) return submitted;
    if (!learn(verdict) || rejected + 1 == settings_.rejections) return Submitted::rejected;
    outcome = retrieve(state, all_movables_, outcome.path->grasp + 1, WorkerId(0));
  }
}

RetrievalOutcome RearrangementQuery::retrieve(const WorldState& state, const ObjectSet& obstacles, int first_grasp,
                                              WorkerId worker) {
  return retrievals_->plan(workers_[worker.index()]->collision(), state, obstacles, first_grasp, context_.stop);
}

std::vector<VoxelVolume> RearrangementQuery::negative_goal_regions() {
  const WorldState start = WorldState::start_of(scene());
  const Eigen::AlignedBox3d space = object_space(scene());
  struct Region {
    std::pair<int, std::int64_t> load;  // movables inside, cells that they fill
    VoxelVolume volume;
    RetrievalPath path;
    JobBoard::Handle job;
  };
  std::deque<Region> found;
  std::map<std::string, std::int64_t> failures;
  bool exhausted = true;
  for (const RetrievalPlanner::Obstruction& least :
       retrievals_->least_obstructed(workers_.front()->collision(), start, all_movables_, settings_.regions)) {
    RetrievalOutcome outcome = retrieve(start, ObjectSet(scene().size()), least.grasp, WorkerId(0));
    if (outcome.stopped) {
      for (Region& region : found) board_.finish(region.job);
      return stopped(), std::vector<VoxelVolume>{};
    }
    if (!outcome.path) {
      failures = outcome.failures;
      exhausted = outcome.exhausted;
      continue;
    }
    Region& region = found.emplace_back();
    region.path = *std::move(outcome.path);
    // One worker sweeps a volume while another looks for the next retrieval.
    region.job = board_.post(0, [this, &region, &start, &space](WorkerId, const std::atomic<bool>&) {
      const auto grasp = static_cast<std::size_t>(region.path.grasp);
      region.volume = swept_volume(problem_, *kinematics_, region.path, retrievals_->candidates()[grasp], start, space,
                                   settings_.retrieval.cell);
      for (ObjectId id : movables_) {
        const std::int64_t cells = region.volume.overlap(scene()[id], start.X_WO(id)).common_cells;
        region.load.first += cells > 0;
        region.load.second += cells;
      }
    });
  }
  for (Region& region : found) board_.finish(region.job);
  std::ranges::stable_sort(found, {}, &Region::load);
  std::vector<VoxelVolume> out;
  for (Region& region : found) out.push_back(std::move(region.volume));
  if (!out.empty()) return out;

  count_failures(retrievals_->rejected(), "grasp_");
  count_failures(failures, "retrieval_");
  std::string causes;
  for (const auto& [cause, number] : result_.stats.failures)
    causes += (causes.empty() ? "" : ", ") + cause + " " + std::to_string(number);
  const std::string what =
      "no way to grasp " + scene()[target_].id + " and bring it home even without the movable objects (" + causes + ")";
  if (exhausted)
    finish(PlanStatus::proven, what + ", given the grasps drawn (grasps, grasp_solutions)");
  else
    finish(PlanStatus::limit, what + "; grasps, grasp_solutions and retrieval_nodes raise the effort");
  return out;
}

bool RearrangementQuery::count(ObjectId object, const PushOutcome& outcome) {
  PlanStats& stats = result_.stats;
  if (outcome.failure == PushFailure::stopped) return stopped(), false;
  if (stats.simulations_used + outcome.simulations > options_.max_simulations) {
    finish(PlanStatus::limit, "no plan within the limit on simulations; --max-simulations raises it");
    return false;
  }
  ++stats.push_attempts;
  stats.simulations_used += outcome.simulations;
  stats.collision_checks += outcome.collision_checks;
  const PushTimes& t = outcome.times;
  stats.push_planning_s += t.start + t.way + t.approach + t.retreat;
  signature_.add(static_cast<std::int32_t>(outcome.failure));
  if (outcome.valid()) return true;
  const std::string cause = outcome.violation ? "simulation_" + std::string(to_string(outcome.violation->kind))
                                              : std::string(to_string(outcome.failure));
  ++stats.failures["push_" + cause];
  ++causes_[object][cause];
  return true;
}

void RearrangementQuery::count_failures(const std::map<std::string, std::int64_t>& failures,
                                        const std::string& prefix) {
  for (const auto& [cause, number] : failures) result_.stats.failures[prefix + cause] += number;
}

std::string RearrangementQuery::failed_attempts(ObjectId object) const {
  const auto causes = causes_.find(object);
  std::string list;
  if (causes != causes_.end())
    for (const auto& [cause, number] : causes->second)
      list += (list.empty() ? "" : ", ") + cause + " " + std::to_string(number);
  return list;
}

void RearrangementQuery::finish(PlanStatus status, std::string reason) {
  over_ = true;
  result_.status = status;
  result_.reason = std::move(reason);
  if (status != PlanStatus::solved) result_.plan = {};
}

void RearrangementQuery::stopped() {
  switch (stop().reason()) {
    case StopReason::interrupted:
      return finish(PlanStatus::interrupted, "interrupted");
    case StopReason::memory:
      return finish(PlanStatus::memory, "the memory limit was reached; --memory-limit raises it");
    default:
      return finish(PlanStatus::timeout,
                    "no plan within the time limit; --time-limit raises it; " + what_is_in_the_way());
  }
}

void RearrangementQuery::report_progress(double best_bound, int rearrangements) {
  if (!context_.on_progress) return;
  context_.on_progress(
      {watch_.seconds(), result_.stats.expansions, result_.stats.simulations_used, best_bound, rearrangements, 1});
}

}  // namespace mamo
