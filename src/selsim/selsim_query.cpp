#include "selsim/selsim_query.hpp"

#include <fstream>

#include "mamo/lattice/shortcut.hpp"
#include "mamo/search/parallel_search.hpp"
#include "mamo/selsim/relevant_object.hpp"

namespace mamo {

SelSimQuery::SelSimQuery(const SelSimVariant& variant, const Problem& problem, const PlanOptions& options,
                         const PlanContext& context)
    : variant_(variant), problem_(problem), options_(options), context_(context) {
  settings_.table().apply(options.set);
  weight_ = options.weight > 0 ? options.weight : settings_.weight;
  result_.planner = variant.name;
  result_.seed = options.seed;
  result_.threads = options.threads;
}

void SelSimQuery::prepare() {
  kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
  executor_ = std::make_unique<Executor>(std::max(1, options_.threads));
  for (int w = 0; w < executor_->workers(); ++w)
    workers_.push_back(std::make_unique<EdgeEvaluator>(problem_, kinematics_, settings_.lattice.collision));
  if (settings_.lattice.memo) memo_ = workers_.front()->make_memo();
  for (const auto& worker : workers_) worker->use_memo(memo_);
  everything_ = make_relevant_bodies(problem_, ObjectSet::all(problem_.scene));
  // Bodies that stay put and may not be touched: walls for goal configurations and heuristic alike.
  ObjectSet immovable = ObjectSet::of_kind(problem_.scene, ObjectKind::immovable);
  walls_ = ObjectSet(problem_.scene.size());
  for (ObjectId id : everything_.forbidden.ids())
    if (!problem_.scene[id].movable()) walls_.insert(id);
  relevant_ = !variant_.selective                    ? ObjectSet::all(problem_.scene)
              : settings_.immovables == "discovered" ? ObjectSet(problem_.scene.size())
                                                     : immovable;
  const TrackedPoint point = tracked_point(*kinematics_);
  ReachGoal goal = make_reach_goal(problem_, *kinematics_, point, evaluator().collision(), walls_, options_.seed,
                                   settings_.lattice.goal_configurations);
  GoalChains chains = make_goal_chains(problem_, evaluator().collision(), walls_, goal.configurations, options_.seed,
                                       settings_.lattice.chains, context_.stop);
  round_expansions_ = settings_.round_expansions;
  chain_budget_used_up_ = chains.budget_used_up;
  model_ = std::make_unique<LatticeModel>(problem_, kinematics_, settings_.lattice, std::move(goal),
                                          std::move(chains.chains), point, walls_);
}

bool SelSimQuery::widen() {
  if (result_.stats.expansions >= options_.max_expansions || context_.stop->stopped()) return false;
  ++round_;
  round_expansions_ *= 2;
  const std::uint64_t seed = hash_combine(options_.seed, static_cast<std::uint64_t>(round_));
  const std::vector<Eigen::VectorXd> known = model_->goal().configurations;
  const ReachGoal drawn = make_reach_goal(problem_, *kinematics_, tracked_point(*kinematics_), evaluator().collision(),
                                          walls_, seed, settings_.lattice.goal_configurations);
  std::vector<Eigen::VectorXd> fresh;
  for (const Eigen::VectorXd& q : drawn.configurations)
    if (std::none_of(known.begin(), known.end(), [&](const Eigen::VectorXd& k) {
          return (k - q).cwiseAbs().maxCoeff() < IkOptions{}.min_separation;
        }))
      fresh.push_back(q);
  // New goals first: chains to the old ones were drawn in earlier rounds. If there are none, other ways to the old
  // ones.
  const int first = fresh.empty() ? 0 : static_cast<int>(known.size());
  GoalChains chains = make_goal_chains(problem_, evaluator().collision(), walls_, fresh.empty() ? known : fresh, seed,
                                       settings_.lattice.chains, context_.stop);
  for (GoalChain& chain : chains.chains) chain.goal += first;
  chain_budget_used_up_ = chain_budget_used_up_ || chains.budget_used_up;
  model_->add_goals(fresh);
  model_->add_chains(std::move(chains.chains));
  return true;
}

SelSimQuery::Search SelSimQuery::search_once() {
  const ManipulationLattice lattice(problem_, *model_, make_relevant_bodies(problem_, relevant_), banned_,
                                    context_.stop, memo_);
  std::vector<ManipulationLattice::Context> contexts;
  for (const auto& worker : workers_) contexts.push_back({worker.get(), {}});
  search::ParallelOptions parallel;
  parallel.schedule = search::schedule_from(options_.schedule).value_or(search::Schedule::runahead);
  parallel.batch = options_.batch;
  parallel.executor = executor_.get();
  search::Trace trace;
  if (!options_.trace_path.empty()) parallel.trace = &trace;
  search::SearchOptions options;
  options.weight = weight_;
  options.max_expansions = std::min(options_.max_expansions - result_.stats.expansions, round_expansions_);
  options.max_charge = options_.max_simulations - result_.stats.simulations_used;
  options.stop = context_.stop;
  if (context_.on_progress)
    options.on_progress = [&](const search::SearchProgress& p) {
      context_.on_progress({watch_.seconds(), result_.stats.expansions + p.expansions,
                            result_.stats.simulations_used + p.charge, p.open_min_f,
                            static_cast<int>(relevant_.ids().size()), result_.stats.planning_iterations});
    };
  const Stopwatch watch;
  const std::span<ManipulationLattice::Context> all(contexts);
  Search found = variant_.lazy ? search::parallel_lazy_weighted_astar(lattice, all, options, parallel)
                               : search::parallel_weighted_astar(lattice, all, options, parallel);
  if (trace.wall_s > trace_.wall_s) trace_ = std::move(trace);
  PlanStats& stats = result_.stats;
  stats.search_s += watch.seconds();
  stats.expansions += found.counters.expansions;
  stats.simulations_used += found.counters.charge;
  stats.collision_checks += found.counters.work;
  for (const auto& [tag, count] : found.counters.tags)
    if (tag > 0) stats.failures[failure_name(tag)] += count;
  ++stats.planning_iterations;
  signature_.add(found.order_hash);
  merged_ = merged_ || found.merged;
  return found;
}

std::int64_t SelSimQuery::length(const std::vector<Eigen::VectorXd>& path) {
  double sum = 0;
  for (std::size_t k = 1; k < path.size(); ++k) sum += (path[k] - path[k - 1]).norm();
  return static_cast<std::int64_t>(std::ceil(1000.0 * sum - 1e-6));
}

SelSimQuery::Candidate SelSimQuery::candidate_of(const Search& found) const {
  Candidate candidate;
  candidate.path.push_back(problem_.q_start);
  for (std::size_t k = 0; k < found.path.size(); ++k)
    for (Eigen::VectorXd& q : model_->legs(found.path[k].parent, found.path[k].action)) {
      candidate.path.push_back(std::move(q));
      candidate.step_of_leg.push_back(static_cast<int>(k));
    }
  return candidate;
}

Plan SelSimQuery::plan_of(const Track& track) const {
  Segment segment;
  segment.kind = SegmentKind::reach;
  for (int i = 0; i < problem_.robot.dof(); ++i) segment.joint_names.push_back(problem_.robot.joint(i).name);
  segment.motion = track.motion;
  for (ObjectId id : everything_.relevant.ids()) segment.objects_after[id] = track.state.X_WO(id);
  return {{segment}};
}

bool SelSimQuery::judged(Candidate& candidate) {
  result_.plan = plan_of(candidate.track);
  if (!context_.judge) return true;
  result_.plan.segments.front().objects_after.clear();  // the replay says where the objects end up
  const Stopwatch watch;
  candidate.verdict = context_.judge->judge(problem_, result_.plan, *context_.stop);
  result_.stats.verification_s += watch.seconds();
  result_.verified = candidate.verdict.ok;
  if (candidate.verdict.ok) result_.plan.segments.front().objects_after = candidate.verdict.objects_after.front();
  return candidate.verdict.ok;
}

bool SelSimQuery::accept(const Search& found) {
  const Stopwatch watch;
  const std::int64_t checks = evaluator().collision_checks();
  Candidate raw = candidate_of(found);
  raw.track = track(problem_, evaluator(), raw.path, everything_, context_.stop);
  Candidate smooth;
  if (raw.track.ok && options_.smooth) {
    smooth.path = shortcut(raw.path, raw.track.touching, raw.track.states, evaluator(), everything_, context_.stop);
    if (smooth.path.size() < raw.path.size())
      smooth.track = track(problem_, evaluator(), smooth.path, everything_, context_.stop);
  }
  result_.stats.tracking_s += watch.seconds();
  result_.stats.tracking_simulations += raw.track.simulations + smooth.track.simulations;
  result_.stats.collision_checks += evaluator().collision_checks() - checks;
  if (raw.track.stopped) return false;
  if (!raw.track.ok) {
    note_refuted(raw, raw.track.failed_edge, raw.track.states.back(), *raw.track.violation);
    learn(raw.track.interactions, *raw.track.violation,
          raw.step_of_leg[static_cast<std::size_t>(raw.track.failed_edge)], found);
    return false;
  }
  if (!result_.found) result_.stats.found_s = watch_.seconds();
  result_.found = true;
  result_.second_order_contacts = raw.track.second_order;
  result_.suboptimality_bound = found.bound;
  result_.cost = length(smooth.path);
  if (smooth.track.ok && judged(smooth)) return true;
  result_.cost = length(raw.path);
  if (smooth.track.ok) ++result_.stats.failures["smoothing_rejected"];
  if (judged(raw)) return true;
  if (raw.verdict.stopped) return false;

  ++result_.rejected_by_verification;
  const Violation& violation = raw.verdict.findings.front().violation;
  const std::vector<double>& t = raw.track.motion.t;
  const auto point = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), violation.time_s) - t.begin());
  const int leg = raw.track.edge_of_point[std::min(point, t.size() - 1)];
  note_refuted(raw, leg, raw.track.states[static_cast<std::size_t>(std::max(leg, 0))], violation);
  learn(raw.verdict.interactions, violation, leg < 0 ? 0 : raw.step_of_leg[static_cast<std::size_t>(leg)], found);
  return false;
}

void SelSimQuery::note_refuted(const Candidate& candidate, int edge, const WorldState& before,
                               const Violation& violation) {
  if (!options_.explain || candidate.path.size() < 2) return;
  const auto k = static_cast<std::size_t>(std::max(edge, 0));
  notes_.refuted(result_.stats.planning_iterations, problem_, *kinematics_, candidate.path[k], candidate.path[k + 1],
                 before, violation);
}

void SelSimQuery::learn(const std::vector<Interaction>& interactions, const Violation& violation, int step,
                        const Search& found) {
  ++result_.stats.failures["replay_" + std::string(to_string(violation.kind))];
  const ObjectId id = relevant_object(interactions, violation.object, relevant_, problem_.scene);
  if (options_.explain) notes_.learned(id);
  if (id.valid()) {
    relevant_.insert(id);
    result_.stats.relevant_objects.push_back(id);
    signature_.add(id.value);
    return;
  }
  ++result_.stats.failures["replay_mismatch"];
  if (found.path.empty()) return;
  const auto& refuted = found.path[static_cast<std::size_t>(step)];
  banned_.insert({refuted.parent, refuted.action});
}

PlanResult& SelSimQuery::finish(PlanStatus status, std::string reason) {
  result_.status = status;
  result_.reason = std::move(reason);
  result_.stats.wall_s = watch_.seconds();
  result_.stats.simulations = -result_.stats.tracking_simulations;
  for (const auto& worker : workers_) {
    result_.stats.simulations += worker->simulations();
    result_.stats.simulation_s += worker->simulation_s();
  }
  result_.stats.simulations = std::max(result_.stats.simulations, result_.stats.simulations_used);
  if (status != PlanStatus::solved) result_.plan = {};
  for (const Segment& segment : result_.plan.segments)
    for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
      signature_.add(segment.motion.t[k]);
      for (Eigen::Index i = 0; i < segment.motion.q[k].size(); ++i) signature_.add(segment.motion.q[k][i]);
    }
  result_.signature = signature_.value();
  if (options_.explain) result_.notes = notes_.take(problem_, *model_);
  if (!options_.trace_path.empty()) {
    std::ofstream out(options_.trace_path);
    search::write_trace(trace_, out);
  }
  return result_;
}

PlanResult& SelSimQuery::stopped() {
  switch (context_.stop->reason()) {
    case StopReason::interrupted:
      return finish(PlanStatus::interrupted, "interrupted");
    case StopReason::memory:
      return finish(PlanStatus::memory, "the memory limit was reached; --memory-limit raises it");
    default:
      return finish(PlanStatus::timeout, "no plan within the time limit; --time-limit raises it");
  }
}

PlanResult& SelSimQuery::out_of_simulations() {
  return finish(PlanStatus::limit, "no plan within the limit on simulations; --max-simulations raises it");
}

PlanResult& SelSimQuery::no_path(const Search& search) {
  switch (search.reason) {
    case search::EndReason::stopped:
      return stopped();
    case search::EndReason::limit_expansions:
      if (context_.stop->stopped()) return stopped();  // before the lattice could be widened
      return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it");
    case search::EndReason::limit_charge:
      return out_of_simulations();
    default:
      break;
  }
  std::string doubt;
  if (search.counters.pruned_infinite > 0) doubt = "states without a way to the goal in the grid heuristic were pruned";
  if (merged_) doubt = "states with nearly equal object poses were merged (exact_objects=true keeps them apart)";
  if (!banned_.empty()) doubt = "motions that the replay refuted were banned";
  if (model_->goal().ik_budget_used_up)
    doubt = "inverse kinematics found fewer goal configurations than asked for (goal_configurations lowers that)";
  if (chain_budget_used_up_)
    doubt =
        "a way to the goal was searched until its budget was used up (chain_nodes raises it, chains=0 does without)";
  if (!doubt.empty()) return finish(PlanStatus::limit, "the lattice is exhausted, which proves nothing: " + doubt);
  return finish(PlanStatus::proven,
                "no plan exists in this lattice (joint_resolution_deg, long_step_deg, short_step_deg, "
                "goal_configurations), given that some plan without second-order interactions exists if any does "
                "(assumption A1 of the paper)");
}

PlanResult SelSimQuery::run() {
  prepare();
  if (model_->goal().configurations.empty())
    return finish(PlanStatus::limit,
                  "no goal configuration is free of collision (" +
                      std::to_string(model_->goal().rejected_in_collision) +
                      " inverse-kinematics solutions hit the robot itself, a fixture or an immovable)");
  while (result_.stats.planning_iterations < settings_.max_iterations) {
    const Search found = search_once();
    if (found.reason == search::EndReason::limit_expansions && widen()) continue;
    if (!found.found()) return no_path(found);
    if (result_.stats.simulations_used > options_.max_simulations)
      return out_of_simulations();  // by its last action's legs
    if (accept(found)) return finish(PlanStatus::solved, "");
    if (context_.stop->stopped()) return stopped();
    if (found.path.empty())
      return finish(PlanStatus::limit, "the start fulfils the task, but the replay of standing still is refused");
  }
  return finish(PlanStatus::limit,
                "no plan within max_iterations planning iterations; --set max_iterations=N raises it");
}

}  // namespace mamo
