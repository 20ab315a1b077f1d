#include "mamo/lattice/outcome_memo.hpp"

#include "mamo/common/hash.hpp"

namespace mamo {
namespace {

std::uint64_t key_of(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) {
  HashStream h;
  for (const Eigen::VectorXd* q : {&q0, &q1})
    for (Eigen::Index i = 0; i < q->size(); ++i) h.add((*q)[i]);
  return h.value();
}

}  // namespace

OutcomeMemo::OutcomeMemo(const Scene& scene, const Evaluator& evaluator) {
  for (std::size_t i = 0; i < scene.size(); ++i) balls_.push_back(evaluator.ball(ObjectId(i)));
}

bool OutcomeMemo::answers(const Evaluation& outcome, const ObjectSet& known, const WorldState& at,
                          const ObjectSet& present, const WorldState& from) const {
  for (const ObjectId id : outcome.took_part.ids())
    if (known.contains(id) && !present.contains(id)) return false;
  for (const ObjectId id : present.ids()) {
    if (known.contains(id) && at[id] == from[id]) continue;
    if (outcome.took_part.contains(id)) return false;
    const World::Ball& ball = balls_[id.index()];
    const Eigen::Vector3d centre = from.X_WO(id) * ball.centre;
    // The cube about the ball meets no box that is further away than this.
    for (const Eigen::AlignedBox3d& box : outcome.swept)
      if (box.squaredExteriorDistance(centre) <= 3 * ball.radius * ball.radius) return false;
  }
  return true;
}

std::shared_ptr<const SimulatedMotion> OutcomeMemo::find(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                                         const ObjectSet& present, const WorldState& from) const {
  const std::uint64_t key = key_of(q0, q1);
  const Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  const auto it = s.motions.find(key);
  if (it == s.motions.end()) return nullptr;
  for (const auto& m : it->second)
    if (m->q0 == q0 && m->q1 == q1 && answers(m->outcome, m->present, m->from, present, from)) return m;
  return nullptr;
}

void OutcomeMemo::insert(std::shared_ptr<const SimulatedMotion> motion) {
  const std::uint64_t key = key_of(motion->q0, motion->q1);
  Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  s.motions[key].push_back(std::move(motion));
}

bool OutcomeMemo::charged(const SimulatedMotion& motion, const ObjectSet& present, const WorldState& from) {
  const std::uint64_t key = key_of(motion.q0, motion.q1);
  Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  std::vector<Charge>& charges = s.charges[key];
  for (const Charge& c : charges)
    if (answers(motion.outcome, c.present, c.from, present, from)) return false;
  charges.push_back({present, from});
  return true;
}

}  // namespace mamo
