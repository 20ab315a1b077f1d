#include "em4m/em4m_query.hpp"

#include <algorithm>

#include "mamo/rearrangement/rearrangement_plan.hpp"

namespace mamo {

Em4mQuery::Em4mQuery(const Em4mVariant& variant, const Problem& problem, const PlanOptions& options,
                     const PlanContext& context, const Em4mOptions& settings)
    : RearrangementQuery(variant.name, problem, options, context, settings.rearrangement),
      variant_(variant),
      settings_(settings),
      notes_(problem) {}

void Em4mQuery::search() {
  search_rearrangements();
  if (options().explain) result().notes = notes_.take();
}

void Em4mQuery::search_rearrangements() {
  const WorldState start = WorldState::start_of(scene());
  if (variant_.retrieves && try_retrievals({}, start, retrieve(start, all_movables(), 0, WorkerId(0)),
                                           [](const Verdict&) { return true; }) != Submitted::rejected)
    return;
  regions_ = negative_goal_regions();
  if (options().explain && !regions_.empty()) notes_.region(regions_.front());
  for (int r = 0; r < static_cast<int>(regions_.size()); ++r) {
    Vertex& root = add_vertex(r, nullptr, {}, start);
    root.retrieval_tried = true;
    open(root);
  }
  while (!over() && !open_.empty()) {
    if (stop().stopped()) return stopped();
    if (result().stats.expansions >= options().max_expansions)
      return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it");
    Vertex& vertex = **open_.begin();
    if (refuted(vertex)) {
      close(vertex);
      continue;
    }
    if (done(vertex) || over()) return;
    expand(vertex);
    report_progress(best_->promise[0], static_cast<int>(vertices_.size()));
  }
  if (!over())
    finish(PlanStatus::limit,
           "every rearrangement that was found is used up, which proves nothing; " + what_is_in_the_way());
}

std::string Em4mQuery::what_is_in_the_way() const {
  if (!best_) return "no way to retrieve the object was found yet";
  const std::string seen = std::to_string(vertices_.size()) + " rearrangements, " +
                           std::to_string(result().stats.push_attempts) + " pushes tried; ";
  std::string text;
  for (ObjectId id : movables()) {
    if (best_->loads[id.index()].cells == 0) continue;
    const std::string failed = failed_attempts(id);
    text += (text.empty() ? "" : ", ") + scene()[id].id + (failed.empty() ? "" : " (failed pushes: " + failed + ")");
  }
  if (text.empty()) return seen + "the region to be cleared is free, but the retrieval was not found or not verified";
  return seen + "at best still in the way: " + text;
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
  v.loads = parent ? parent->loads : std::vector<ObjectLoad>(scene().size());
  for (ObjectId id : movables())
    if (!parent || parent->state[id] != v.state[id])
      v.loads[id.index()] = object_load(volume, scene()[id], v.state.X_WO(id));
  const RegionFeatures features = region_features(volume, v.loads);
  if (variant_.on_vertex) variant_.on_vertex(v.state, features);
  v.promise = v.priority = priority_of(v, features);
  if (!best_ || MorePromising()(&v, best_)) best_ = &v;
  return v;
}

Priority Em4mQuery::priority_of(const Vertex& vertex, const RegionFeatures& features) const {
  if (variant_.order == Em4mOrder::breadth_first) return {-settings_.patience * vertex.pushes, 0, 0};
  if (variant_.order == Em4mOrder::depth_first && features.phi2 > 0) return {settings_.patience * vertex.pushes, 0, 0};
  return variant_.learned_priority ? learned_priority(features, settings_.priority) : lexicographic_priority(features);
}

void Em4mQuery::open(Vertex& vertex) {
  fewest_pushes_[{vertex.region, class_of(scene(), movables(), vertex.state)}] = vertex.pushes;
  open_.insert(&vertex);
  vertex.retrieval_tried = vertex.retrieval_tried || !variant_.retrieves;
  if (!vertex.retrieval_tried) post_retrieval(vertex);
}

void Em4mQuery::reorder(Vertex& vertex) {
  open_.erase(&vertex);
  vertex.priority = vertex.promise;
  vertex.priority[0] -= settings_.patience * vertex.expansions;
  open_.insert(&vertex);
}

void Em4mQuery::close(Vertex& vertex) {
  open_.erase(&vertex);
  board().drop(vertex.retrieval_job);
}

void Em4mQuery::add_successor(Vertex& vertex, const ObjectPath& path, std::shared_ptr<const PushOutcome> push,
                              WorldState after) {
  const auto known = fewest_pushes_.find({vertex.region, class_of(scene(), movables(), after)});
  if (known != fewest_pushes_.end() && known->second <= vertex.pushes + 1) {
    ++result().stats.failures["push_leads_to_known"];
    return;
  }
  open(add_vertex(vertex.region, &vertex, {path.object, path.goal, std::move(push)}, std::move(after)));
}

bool Em4mQuery::refuted(const Vertex& vertex) {
  for (const Vertex* v = &vertex; v; v = v->parent)
    if (v->refuted) return true;
  return false;
}

std::vector<Vertex*> Em4mQuery::chain_of(Vertex& vertex) {
  std::vector<Vertex*> chain;
  for (Vertex* v = &vertex; v->parent; v = v->parent) chain.push_back(v);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

void Em4mQuery::post_retrieval(Vertex& vertex) {
  constexpr int kUrgency = 100;  // after the attempts of the present expansion
  vertex.retrieval = std::make_shared<RetrievalOutcome>();
  vertex.retrieval_job =
      board().post(kUrgency, [this, &vertex, out = vertex.retrieval](WorkerId w, const std::atomic<bool>&) {
        *out = retrieve(vertex.state, all_movables(), 0, w);
      });
}

bool Em4mQuery::done(Vertex& vertex) {
  if (vertex.retrieval_tried) return false;
  vertex.retrieval_tried = true;
  board().finish(vertex.retrieval_job);
  std::vector<Step> pushes;
  for (const Vertex* v : chain_of(vertex)) pushes.push_back({v->step.object, v->step.push});
  return try_retrievals(pushes, vertex.state, std::move(*vertex.retrieval), [&](const Verdict& verdict) {
           learn(verdict, vertex);
           return !refuted(vertex);
         }) != Submitted::rejected;
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
      ++result().stats.failures["replay_mismatch"];
      last.refuted = true;
      open(add_vertex(last.region, last.parent, last.step, std::move(seen)));
      return;
    }
  }
  if (held < chain.size()) chain[held]->refuted = true;
}

}  // namespace mamo
