#include "baselines/m4m_query.hpp"

#include <algorithm>

#include "mamo/common/random.hpp"
#include "mamo/rearrangement/rearrangement_plan.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kChoice = 0x6d346d;  // "m4m"

}  // namespace

void M4mQuery::search() {
  state_ = WorldState::start_of(scene());
  const std::vector<VoxelVolume> regions = negative_goal_regions();
  if (regions.empty()) return;
  region_ = regions.front();
  while (!over()) {
    if (stop().stopped()) return stopped();
    if (retrieved() || over()) return;
    if (result().stats.expansions >= options().max_expansions)
      return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it");
    if (result().stats.expansions >= settings_.max_rearrangements)
      return finish(PlanStatus::limit, "no plan within max_rearrangements pushes; " + what_is_in_the_way());
    push_somebody();
    report_progress(0, static_cast<int>(pushes_.size()));
  }
}

std::string M4mQuery::what_is_in_the_way() const {
  if (region_.count() == 0) return "no way to retrieve the object was found yet";
  std::string text;
  for (ObjectId id : movables()) {
    if (path_finder().clear_of(region_, id, state_)) continue;
    const std::string failed = failed_attempts(id);
    text += (text.empty() ? "" : ", ") + scene()[id].id + (failed.empty() ? "" : " (failed pushes: " + failed + ")");
  }
  const std::string seen = std::to_string(pushes_.size()) + " pushes committed to, " +
                           std::to_string(result().stats.push_attempts) + " tried; ";
  if (text.empty()) return seen + "the region to be cleared is free, but the retrieval was not found or not verified";
  return seen + "still in the way: " + text;
}

bool M4mQuery::retrieved() {
  for (bool again = true; again;) {
    again = false;
    const std::vector<Step> pushes = pushes_;
    const WorldState state = state_;
    const auto learnt = [&](const Verdict& verdict) {
      const bool elsewhere = learn(verdict);
      again = elsewhere && pushes_.size() == pushes.size();
      return !elsewhere;
    };
    RetrievalOutcome first = retrieve(state, all_movables(), 0, WorkerId(0));
    if (try_retrievals(pushes, state, std::move(first), learnt) != Submitted::rejected) return true;
  }
  return false;
}

/// Goes on from what the replay saw. True if that is another rearrangement than planning was at.
bool M4mQuery::learn(const Verdict& verdict) {
  const auto failed = static_cast<std::size_t>(verdict.findings.front().segment / kSegmentsPerPush);
  const std::size_t held = std::min(failed, pushes_.size());  // pushes that the replay carried out
  WorldState seen = held > 0 ? pushes_[held - 1].second->after : WorldState::start_of(scene());
  if (held > 0 && kSegmentsPerPush * held <= verdict.objects_after.size())
    for (const auto& [id, X_WO] : verdict.objects_after[kSegmentsPerPush * held - 1]) seen[id] = quantise(X_WO);
  pushes_.resize(held);
  const bool other = seen != state_;
  if (other) ++result().stats.failures["replay_mismatch"];
  state_ = std::move(seen);
  return other;
}

std::uint64_t M4mQuery::content() const {
  HashStream hash;
  for (ObjectId id : movables()) {
    for (std::int32_t v : state_[id].p) hash.add(v);
    for (std::int32_t v : state_[id].q) hash.add(v);
  }
  return hash.value();
}

void M4mQuery::push_somebody() {
  ++result().stats.expansions;
  ++result().stats.mapf_calls;
  signature().add(content());
  const Stopwatch watch;
  const ObjectPathsResult found = path_finder().solve(state_, region_, {}, &stop());
  result().stats.mapf_s += watch.seconds();
  if (found.stopped) return stopped();
  if (found.solved && !found.paths.empty()) return push_one_of(found.paths);
  const char* why = found.solved ? "mapf_moves_nobody" : found.budget_used_up ? "mapf_budget" : "mapf_unsolvable";
  ++result().stats.failures[why];
  finish(PlanStatus::limit, "the greedy sequence of pushes has come to an end (" + std::string(why) +
                                "), which proves nothing; " + what_is_in_the_way());
}

M4mQuery::Attempt M4mQuery::post(const std::vector<ObjectPath>& paths, int number) {
  const std::uint64_t here = content();
  RandomStream random(options().seed, {kChoice, here, static_cast<std::uint64_t>(number)});
  const ObjectPath& path = paths[random.below(paths.size())];
  Attempt attempt{path.object, std::make_shared<PushOutcome>(), nullptr};
  PushRequest request{path.object, path.points, state_, number, here};
  attempt.job = board().post(
      0, [this, out = attempt.outcome, request = std::move(request)](WorkerId w, const std::atomic<bool>& cancelled) {
        *out = worker(w).attempt(request, &stop(), &cancelled);
      });
  return attempt;
}

void M4mQuery::push_one_of(const std::vector<ObjectPath>& paths) {
  int& tried = tried_[content()];
  const int most = settings_.rearrangement.attempts * static_cast<int>(paths.size());
  const auto ahead = static_cast<std::size_t>(options().threads > 1 ? 2 * options().threads : 1);
  std::deque<Attempt> window;
  int posted = tried;
  bool pushed = false;
  while (!over() && !pushed && tried < most) {
    while (window.size() < ahead && posted < most) window.push_back(post(paths, posted++));
    const Attempt attempt = std::move(window.front());
    window.pop_front();
    board().finish(attempt.job);
    ++tried;
    if (!count(attempt.object, *attempt.outcome) || !attempt.outcome->valid()) continue;
    pushes_.push_back({attempt.object, attempt.outcome});
    pushed = true;
  }
  for (const Attempt& attempt : window) board().drop(attempt.job);
  if (pushed) state_ = pushes_.back().second->after;
  if (!pushed && !over())
    finish(PlanStatus::limit,
           "no push of what has to move was found; attempts raises the effort; " + what_is_in_the_way());
}

}  // namespace mamo
