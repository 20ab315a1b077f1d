#include <algorithm>

#include "retrieval/grasp_set.hpp"

namespace mamo {
namespace {

using retrieval::GraspSet;
using retrieval::Legs;
using retrieval::Phase;
using retrieval::WayHome;

/// Objects that the known retrieval of candidate c touches; more than `limit` of them are not counted.
int touched_by(const GraspSet& set, Legs& legs, std::size_t c, int limit) {
  const GraspCandidate& candidate = set.candidates[c];
  const WayHome& way = set.ways[c];
  ObjectSet touched(set.around.problem.scene.size());
  const auto few = [&] { return static_cast<int>(touched.ids().size()) <= limit; };
  const auto along = [&](Phase phase, const std::vector<Eigen::VectorXd>& path) {
    for (std::size_t k = 1; k < path.size() && few(); ++k) legs.collect(phase, path[k - 1], path[k], touched);
  };
  legs.grip(candidate.reach.back());
  along(Phase::reach, candidate.reach);
  along(Phase::carry, candidate.lift);
  along(Phase::carry, way.path);
  along(Phase::approach, way.approach);
  return static_cast<int>(touched.ids().size());
}

}  // namespace

std::vector<RetrievalPlanner::Obstruction> RetrievalPlanner::least_obstructed(CollisionChecker& checker,
                                                                              const WorldState& state,
                                                                              const ObjectSet& objects,
                                                                              int count) const {
  Legs legs(grasps_->around, checker, state, objects);
  std::vector<Obstruction> best;  // by number, then in order
  for (std::size_t c = 0; c < grasps_->candidates.size() && count > 0; ++c) {
    if (!grasps_->ways[c].known || grasps_->ways[c].approach.empty()) continue;
    const bool full = static_cast<int>(best.size()) == count;
    const int limit = full ? best.back().objects - 1 : static_cast<int>(objects.ids().size());
    const int number = touched_by(*grasps_, legs, c, limit);
    if (full && number > limit) continue;
    if (full) best.pop_back();
    const auto after = std::upper_bound(best.begin(), best.end(), number,
                                        [](int value, const Obstruction& o) { return value < o.objects; });
    best.insert(after, {static_cast<int>(c), number});
  }
  return best;
}

}  // namespace mamo
