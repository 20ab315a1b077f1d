#include "mamo/lattice/shortcut.hpp"

namespace mamo {

std::vector<Eigen::VectorXd> shortcut(const std::vector<Eigen::VectorXd>& path, const std::vector<bool>& touching,
                                      const std::vector<WorldState>& states, EdgeEvaluator& evaluator,
                                      const RelevantBodies& bodies, StopSource* stop) {
  // Contact with a watched object rules a shortcut out before any physics: everything counts as forbidden.
  RelevantBodies untouched = bodies;
  for (ObjectId id : bodies.watched.ids()) untouched.forbidden.insert(id);
  untouched.watched = ObjectSet();

  std::vector<Eigen::VectorXd> out{path.front()};
  std::size_t i = 0;
  while (i + 1 < path.size()) {
    std::size_t end = i + 1;
    while (!touching[i] && end < touching.size() && !touching[end]) ++end;  // last point of the stretch
    std::size_t best = i + 1;
    for (std::size_t j = end; j > i + 1 && !(stop && stop->stopped()); --j) {
      if (!evaluator.evaluate(path[i], path[j], untouched, states[i], stop, nullptr).valid) continue;
      best = j;
      break;
    }
    out.push_back(path[best]);
    i = best;
  }
  return out;
}

}  // namespace mamo
