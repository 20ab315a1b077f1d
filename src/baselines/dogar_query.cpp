#include "baselines/dogar_query.hpp"

#include <algorithm>
#include <cmath>

#include "mamo/rearrangement/rearrangement_plan.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kChoice = 0x646f676172;  // "dogar"
constexpr int kPlaces = 200;                     // random places drawn for one push
constexpr double kAside = 100, kApart = 5;       // m: where objects are set aside, and how far from one another
constexpr double kSweepStep = 0.005;             // m between two poses of a pushed object that are marked

bool overlaps(const VoxelVolume& region, const Object& object, const Eigen::Isometry3d& X_WO) {
  return region.overlap(object, X_WO).common_cells > 0;
}

/// The object on its straight way from one pose to another; it may turn on the way.
void add_object_sweep(VoxelVolume& region, const Object& object, const Eigen::Isometry3d& X_from,
                      const Eigen::Isometry3d& X_to) {
  const Eigen::Vector3d shift = X_to.translation() - X_from.translation();
  const Eigen::Quaterniond from(X_from.linear()), to(X_to.linear());
  const double travel = shift.norm() + 0.1 * from.angularDistance(to);
  const int pieces = std::max(1, static_cast<int>(std::ceil(travel / kSweepStep)));
  for (int i = 0; i <= pieces; ++i) {
    const double s = static_cast<double>(i) / pieces;
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = X_from.translation() + s * shift;
    X.linear() = from.slerp(s, to).toRotationMatrix();
    for (const PlacedShape& placed : object.shapes) region.add(placed.shape, X * placed.X_BS);
  }
}

}  // namespace

void DogarQuery::search() {
  start_ = WorldState::start_of(scene());
  space_ = object_space(scene());
  const std::vector<VoxelVolume> regions = negative_goal_regions();
  if (regions.empty()) return;
  for (; draw_ < settings_.draws; ++draw_) {
    Tail tail{regions[static_cast<std::size_t>(draw_) % regions.size()], {}, ObjectSet(scene().size())};
    attempts_ = 0;
    const bool cleared = clear(tail);
    if (over() || (cleared && submitted(tail)) || over()) return;
    if (stop().stopped()) return stopped();
    report_progress(0, draw_);
    // Nothing was drawn: it would be the same again.
    if (cleared && tail.pushes.empty() && draw_ + 1 >= static_cast<int>(regions.size())) break;
  }
  finish(PlanStatus::limit,
         "no plan within the sequences of pushes drawn; draws and budget raise the effort; " + what_is_in_the_way());
}

std::string DogarQuery::what_is_in_the_way() const {
  std::string text =
      std::to_string(draw_) + " sequences drawn, " + std::to_string(result().stats.push_attempts) + " pushes tried";
  std::string list;
  for (ObjectId id : movables()) {
    const std::string failed = failed_attempts(id);
    if (!failed.empty()) list += (list.empty() ? "" : ", ") + scene()[id].id + " (" + failed + ")";
  }
  return list.empty() ? text : text + "; failed pushes: " + list;
}

/// True: the query is over.
bool DogarQuery::submitted(const Tail& tail) {
  const std::vector<Step> pushes(tail.pushes.rbegin(), tail.pushes.rend());
  WorldState state = start_;
  for (const Step& step : pushes) state[step.first] = step.second->after[step.first];
  const auto pushes_held = [&](const Verdict& verdict) {
    return static_cast<std::size_t>(verdict.findings.front().segment) >= kSegmentsPerPush * pushes.size();
  };
  RetrievalOutcome first = retrieve(state, all_movables(), 0, WorkerId(0));
  return try_retrievals(pushes, state, std::move(first), pushes_held) != Submitted::rejected;
}

std::vector<ObjectId> DogarQuery::inside(const Tail& tail) const {
  std::vector<ObjectId> found;
  for (ObjectId id : movables())
    if (!tail.planned.contains(id) && overlaps(tail.region, scene()[id], start_.X_WO(id))) found.push_back(id);
  return found;
}

bool DogarQuery::out_of_budget() {
  if (stop().stopped()) stopped();
  if (result().stats.expansions >= options().max_expansions)
    finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it");
  return over() || attempts_ >= settings_.budget;
}

/// Plans pushes before `tail` until nobody is in its region. False: not in this way.
bool DogarQuery::clear(Tail& tail) {
  std::vector<ObjectId> found = inside(tail);
  if (found.empty()) return true;
  RandomStream random(options().seed, {kChoice, node_++});
  for (std::size_t i = found.size(); i > 1; --i) std::swap(found[i - 1], found[random.below(i)]);
  for (ObjectId id : found) {
    if (out_of_budget()) return false;
    std::optional<Tail> longer = push_out(tail, id, RandomStream(random.next(), {}));
    if (!longer || !clear(*longer)) continue;
    tail = std::move(*longer);
    return true;
  }
  return false;
}

std::optional<DogarQuery::Tail> DogarQuery::push_out(const Tail& tail, ObjectId object, RandomStream random) {
  ++result().stats.expansions;
  signature().add(object.value);
  std::vector<Attempt> attempts = post(tail, object, random);
  if (attempts.empty()) ++result().stats.failures["no_place_outside"];
  std::optional<Tail> longer;
  for (std::size_t k = 0; k < attempts.size() && !longer; ++k) {
    board().finish(attempts[k].job);
    ++attempts_;
    if (!count(object, *attempts[k].outcome)) break;
    if (attempts[k].outcome->valid() && out_of_region(tail, object, *attempts[k].outcome))
      longer = extended(tail, object, attempts[k].outcome);
  }
  for (const Attempt& attempt : attempts) board().drop(attempt.job);
  return longer;
}

std::vector<DogarQuery::Attempt> DogarQuery::post(const Tail& tail, ObjectId object, RandomStream& random) {
  std::vector<Attempt> attempts;
  const WorldState state = set_aside(tail, object);
  const Eigen::Vector2d here = start_.X_WO(object).translation().head<2>();
  for (int k = 0; k < settings_.rearrangement.attempts; ++k) {
    const std::optional<Eigen::Vector2d> there = place_outside(tail, object, random);
    if (!there) return attempts;
    Attempt& attempt = attempts.emplace_back();
    attempt.outcome = std::make_shared<PushOutcome>();
    PushRequest request{object, {here, *there}, state, k, random.next()};
    attempt.job = board().post(
        k, [this, out = attempt.outcome, request = std::move(request)](WorkerId w, const std::atomic<bool>& cancelled) {
          *out = worker(w).attempt(request, &stop(), &cancelled);
        });
  }
  return attempts;
}

/// What the push of `object` meets: itself and what is moved later. Others stand far away, asleep.
WorldState DogarQuery::set_aside(const Tail& tail, ObjectId object) const {
  WorldState state = start_;
  int place = 0;
  for (ObjectId id : movables()) {
    if (id == object || tail.planned.contains(id)) continue;
    Eigen::Isometry3d X_WO = start_.X_WO(id);
    X_WO.translation().x() += kAside + kApart * place++;
    state[id] = quantise(X_WO);
  }
  return state;
}

std::optional<Eigen::Vector2d> DogarQuery::place_outside(const Tail& tail, ObjectId object,
                                                         RandomStream& random) const {
  Eigen::Isometry3d X_WO = start_.X_WO(object);
  for (int k = 0; k < kPlaces; ++k) {
    X_WO.translation().x() = random.uniform(space_.min().x(), space_.max().x());
    X_WO.translation().y() = random.uniform(space_.min().y(), space_.max().y());
    if (!overlaps(tail.region, scene()[object], X_WO)) return X_WO.translation().head<2>();
  }
  return std::nullopt;
}

bool DogarQuery::out_of_region(const Tail& tail, ObjectId object, const PushOutcome& outcome) {
  if (std::ranges::any_of(outcome.moved, [&](ObjectId id) { return id != object && scene()[id].movable(); })) {
    ++result().stats.failures["push_moves_another"];
    return false;
  }
  if (!overlaps(tail.region, scene()[object], outcome.after.X_WO(object))) return true;
  ++result().stats.failures["push_ends_in_region"];
  return false;
}

DogarQuery::Tail DogarQuery::extended(const Tail& tail, ObjectId object,
                                      std::shared_ptr<const PushOutcome> push) const {
  Tail longer = tail;
  for (const auto* path : {&push->approach, &push->push, &push->retreat})
    add_arm_sweep(longer.region, kinematics(), *path);
  add_object_sweep(longer.region, scene()[object], start_.X_WO(object), push->after.X_WO(object));
  longer.planned.insert(object);
  longer.pushes.push_back({object, std::move(push)});
  return longer;
}

}  // namespace mamo
