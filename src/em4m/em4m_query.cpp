#include "em4m/em4m_query.hpp"

#include <algorithm>

#include "mamo/retrieval/rearrangement_plan.hpp"

namespace mamo {

Em4mQuery::Em4mQuery(const Em4mVariant& variant, const Problem& problem, const PlanOptions& options,
                     const PlanContext& context)
    : variant_(variant), problem_(problem), options_(options), context_(context) {
  settings_.table().apply(options.set);
  settings_.paths.neighbour_penalties = variant.negative_cache;
  result_.planner = variant.name;
  result_.seed = options.seed;
  result_.threads = options.threads;
}

void Em4mQuery::prepare() {
  target_ = std::get<Retrieve>(problem_.task).object;
  all_movables_ = ObjectSet::of_kind(problem_.scene, ObjectKind::movable);
  all_movables_.erase(target_);
  movables_ = all_movables_.ids();
  kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
  executor_ = std::make_unique<Executor>(std::max(1, options_.threads));
  for (int w = 0; w < executor_->workers(); ++w)
    workers_.push_back(std::make_unique<PushPlanner>(problem_, kinematics_, settings_.push, options_.seed));
  retrievals_ = std::make_unique<RetrievalPlanner>(problem_, kinematics_, settings_.retrieval, options_.seed,
                                                   workers_.front()->collision());
  path_finder_ = std::make_unique<ObjectPathFinder>(problem_, target_, settings_.paths);
}

PlanResult Em4mQuery::run() {
  prepare();
  JobBoard::run(*executor_, board_, [this] { search(); });
  result_.stats.wall_s = watch_.seconds();
  result_.stats.search_s = result_.stats.wall_s - result_.stats.verification_s;
  result_.signature = signature_.value();
  return std::move(result_);
}

void Em4mQuery::search() {
  if (!choose_regions()) return;
  for (int r = 0; r < static_cast<int>(regions_.size()); ++r) {
    Vertex& root = add_vertex(r, nullptr, {}, WorldState::start_of(problem_.scene));
    root.retrieval_tried = r > 0;  // the same rearrangement: asked once
    open(root);
  }
  while (!over() && !open_.empty()) {
    if (context_.stop->stopped()) return stopped();
    if (result_.stats.expansions >= options_.max_expansions)
      return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it");
    Vertex& vertex = **open_.begin();
    if (refuted(vertex)) {
      close(vertex);
      continue;
    }
    if (done(vertex) || over()) return;
    expand(vertex);
    if (context_.on_progress)
      context_.on_progress({watch_.seconds(), result_.stats.expansions, result_.stats.simulations_used,
                            best_->priority[0], static_cast<int>(vertices_.size()), 1});
  }
  if (over()) return;
  if (context_.stop->stopped()) return stopped();
  finish(PlanStatus::limit,
         "every rearrangement that was found is used up, which proves nothing (attempts raises the "
         "number of pushes tried); " +
             what_is_in_the_way());
}

bool Em4mQuery::choose_regions() {
  const WorldState start = WorldState::start_of(problem_.scene);
  const Eigen::AlignedBox3d space = object_space(problem_.scene);
  std::vector<std::pair<Priority, VoxelVolume>> found;
  std::map<std::string, std::int64_t> failures;
  bool exhausted = true;
  for (int first = 0; static_cast<int>(found.size()) < settings_.regions;) {
    RetrievalOutcome outcome =
        retrievals_->plan(workers_.front()->collision(), start, ObjectSet(problem_.scene.size()), first, context_.stop);
    if (outcome.stopped) return stopped(), false;
    if (!outcome.path) {
      failures = outcome.failures;
      exhausted = outcome.exhausted;
      break;
    }
    first = outcome.path->grasp + 1;
    VoxelVolume region = swept_volume(problem_, *kinematics_, *outcome.path,
                                      retrievals_->candidates()[static_cast<std::size_t>(outcome.path->grasp)], start,
                                      space, settings_.retrieval.cell);
    std::vector<ObjectLoad> loads(problem_.scene.size());
    for (ObjectId id : movables_) loads[id.index()] = object_load(region, problem_.scene[id], start.X_WO(id));
    const Priority load = lexicographic_priority(region_features(region, loads));
    found.push_back({{load[1], load[0], load[2]}, std::move(region)});  // fewer objects, then less of them
  }
  std::ranges::stable_sort(found, std::greater(), [](const auto& entry) { return entry.first; });
  for (auto& [load, region] : found) regions_.push_back(std::move(region));
  if (!regions_.empty()) return true;
  count_failures(retrievals_->rejected(), "grasp_");
  count_failures(failures, "retrieval_");
  std::string causes;
  for (const auto& [cause, count] : result_.stats.failures)
    causes += (causes.empty() ? "" : ", ") + cause + " " + std::to_string(count);
  const std::string what = "no way to grasp " + problem_.scene[target_].id +
                           " and bring it home even without the movable objects (" + causes + ")";
  if (exhausted)
    finish(PlanStatus::proven, what + ", given the grasps drawn (grasps, grasp_solutions)");
  else
    finish(PlanStatus::limit, what + "; grasps, grasp_solutions and retrieval_nodes raise the effort");
  return false;
}

Vertex& Em4mQuery::add_vertex(int region, Vertex* parent, PushStep step, WorldState state) {
  const VoxelVolume& volume = regions_[static_cast<std::size_t>(region)];
  Vertex& v = vertices_.emplace_back();
  v.number = static_cast<int>(vertices_.size()) - 1;
  v.parent = parent;
  v.region = region;
  v.step = std::move(step);
  v.pushes = parent ? parent->pushes + 1 : 0;
  v.state = std::move(state);
  v.loads = parent ? parent->loads : std::vector<ObjectLoad>(problem_.scene.size());
  for (ObjectId id : movables_)
    if (!parent || parent->state[id] != v.state[id])
      v.loads[id.index()] = object_load(volume, problem_.scene[id], v.state.X_WO(id));
  const RegionFeatures features = region_features(volume, v.loads);
  v.promise = v.priority =
      variant_.learned_priority ? learned_priority(features, settings_.priority) : lexicographic_priority(features);
  if (!best_ || MorePromising()(&v, best_)) best_ = &v;
  return v;
}

void Em4mQuery::open(Vertex& vertex) {
  fewest_pushes_[{vertex.region, class_of(problem_.scene, movables_, vertex.state)}] = vertex.pushes;
  open_.insert(&vertex);
  if (!vertex.retrieval_tried) post_retrieval(vertex, 100);
}

void Em4mQuery::add_successor(Vertex& vertex, const ObjectPath& path, std::shared_ptr<const PushOutcome> push,
                              WorldState after) {
  const auto known = fewest_pushes_.find({vertex.region, class_of(problem_.scene, movables_, after)});
  if (known != fewest_pushes_.end() && known->second <= vertex.pushes + 1) {
    ++result_.stats.failures["push_leads_to_known"];
    return;
  }
  open(add_vertex(vertex.region, &vertex, {path.object, path.goal, std::move(push)}, std::move(after)));
}

void Em4mQuery::reorder(Vertex& vertex) {
  open_.erase(&vertex);
  vertex.priority = vertex.promise;
  vertex.priority[0] -= settings_.patience * vertex.expansions;
  open_.insert(&vertex);
}

void Em4mQuery::close(Vertex& vertex) {
  vertex.closed = true;
  open_.erase(&vertex);
  board_.drop(vertex.retrieval_job);
}

bool Em4mQuery::refuted(const Vertex& vertex) const {
  for (const Vertex* v = &vertex; v; v = v->parent)
    if (v->refuted) return true;
  return false;
}

void Em4mQuery::post_retrieval(Vertex& vertex, int urgency) {
  vertex.retrieval = std::make_shared<RetrievalOutcome>();
  vertex.retrieval_job =
      board_.post(urgency, [this, &vertex, out = vertex.retrieval](WorkerId worker, const std::atomic<bool>&) {
        *out = retrievals_->plan(workers_[worker.index()]->collision(), vertex.state, all_movables_, 0, context_.stop);
      });
}

std::vector<Vertex*> Em4mQuery::chain_of(Vertex& vertex) {
  std::vector<Vertex*> chain;
  for (Vertex* v = &vertex; v->parent; v = v->parent) chain.push_back(v);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

bool Em4mQuery::done(Vertex& vertex) {
  if (vertex.retrieval_tried) return false;
  vertex.retrieval_tried = true;
  board_.finish(vertex.retrieval_job);
  RetrievalOutcome outcome = *vertex.retrieval;
  for (int rejected = 0;; ++rejected) {
    if (outcome.stopped) return stopped(), true;
    count_failures(outcome.failures, "retrieval_");
    if (!outcome.path) return false;
    if (!result_.found) result_.stats.found_s = watch_.seconds();
    result_.found = true;
    std::vector<std::pair<ObjectId, const PushOutcome*>> pushes;
    for (const Vertex* v : chain_of(vertex)) pushes.push_back({v->step.object, v->step.push.get()});
    result_.plan = rearrangement_plan(problem_, pushes, *outcome.path);
    if (!context_.judge) return finish(PlanStatus::solved, ""), true;
    const Stopwatch watch;
    const Verdict verdict = context_.judge->judge(problem_, result_.plan, *context_.stop);
    result_.stats.verification_s += watch.seconds();
    if (verdict.stopped) return stopped(), true;
    result_.verified = verdict.ok;
    if (verdict.ok) {
      for (std::size_t s = 0; s < result_.plan.segments.size(); ++s)
        result_.plan.segments[s].objects_after = verdict.objects_after[s];
      return finish(PlanStatus::solved, ""), true;
    }
    ++result_.rejected_by_verification;
    ++result_.stats.failures["replay_" + std::string(to_string(verdict.findings.front().violation.kind))];
    const bool pushes_hold = verdict.findings.front().segment >= kSegmentsPerPush * static_cast<int>(pushes.size());
    learn(verdict, vertex);
    if (!pushes_hold || rejected + 1 >= settings_.rejections || refuted(vertex)) return false;
    outcome = retrievals_->plan(workers_.front()->collision(), vertex.state, all_movables_, outcome.path->grasp + 1,
                                context_.stop);
  }
}

void Em4mQuery::learn(const Verdict& verdict, Vertex& vertex) {
  const std::vector<Vertex*> chain = chain_of(vertex);
  const auto failed = static_cast<std::size_t>(verdict.findings.front().segment / kSegmentsPerPush);
  const std::size_t held = std::min(failed, chain.size());  // pushes that the replay carried out
  if (held > 0 && kSegmentsPerPush * held <= verdict.objects_after.size()) {
    Vertex& last = *chain[held - 1];
    WorldState seen = last.state;
    for (const auto& [id, X_WO] : verdict.objects_after[kSegmentsPerPush * held - 1]) seen[id] = quantise(X_WO);
    if (seen != last.state) {  // what planning predicted was off: go on from what the replay saw
      ++result_.stats.failures["replay_mismatch"];
      last.refuted = true;
      open(add_vertex(last.region, last.parent, last.step, std::move(seen)));
      return;
    }
  }
  if (held < chain.size()) chain[held]->refuted = true;
}

void Em4mQuery::expand(Vertex& vertex) {
  if (!grow_invalid_goals(vertex)) return close(vertex);
  ++result_.stats.expansions;
  ++vertex.expansions;
  reorder(vertex);
  signature_.add(content_hash(movables_, vertex.state));
  const Stopwatch watch;
  const ObjectPathsResult found = path_finder_->solve(vertex.state, regions_[static_cast<std::size_t>(vertex.region)],
                                                      vertex.invalid, context_.stop);
  result_.stats.mapf_s += watch.seconds();
  ++result_.stats.mapf_calls;
  if (found.stopped) return stopped();
  if (!found.solved || found.paths.empty()) {
    ++result_.stats.failures[found.solved           ? "mapf_moves_nobody"
                             : found.budget_used_up ? "mapf_budget"
                                                    : "mapf_unsolvable"];
    return close(vertex);
  }
  std::vector<std::vector<Attempt>> attempts = post_attempts(vertex, found.paths);
  for (std::size_t p = 0; p < found.paths.size() && !over(); ++p) {
    const ObjectPath& path = found.paths[p];
    if (push_object(vertex, path, attempts[p])) {
      vertex.valid_goals.push_back({path.object, path.goal});
    } else if (!over()) {
      vertex.invalid[path.object][path.goal] += settings_.attempts;
      vertex.news = true;
    }
  }
  for (std::vector<Attempt>& of_object : attempts)
    for (Attempt& attempt : of_object) board_.drop(attempt.job);
}

bool Em4mQuery::grow_invalid_goals(Vertex& vertex) {
  if (!vertex.news) {
    if (vertex.valid_goals.empty()) return false;
    for (const auto& [object, goal] : vertex.valid_goals) vertex.invalid[object].emplace(goal, 1);
    vertex.valid_goals.clear();
  }
  vertex.news = false;
  return true;
}

}  // namespace mamo
