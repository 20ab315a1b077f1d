// How a query of E-M4M ends, and what it says about it.
#include <algorithm>

#include "em4m/em4m_query.hpp"

namespace mamo {

void Em4mQuery::finish(PlanStatus status, std::string reason) {
  ended_ = true;
  result_.status = status;
  result_.reason = std::move(reason);
  for (const auto& worker : workers_) result_.stats.simulation_s += worker->simulation_s();
  for (const auto& worker : workers_) result_.stats.simulations += worker->simulations();
  if (status != PlanStatus::solved) result_.plan = {};
  for (const Segment& segment : result_.plan.segments)
    for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
      signature_.add(segment.motion.t[k]);
      for (Eigen::Index i = 0; i < segment.motion.q[k].size(); ++i) signature_.add(segment.motion.q[k][i]);
    }
}

void Em4mQuery::stopped() {
  switch (context_.stop->reason()) {
    case StopReason::interrupted:
      return finish(PlanStatus::interrupted, "interrupted");
    case StopReason::memory:
      return finish(PlanStatus::memory, "the memory limit was reached; --memory-limit raises it");
    default:
      return finish(PlanStatus::timeout,
                    "no plan within the time limit (--time-limit raises it); " + what_is_in_the_way());
  }
}

std::string Em4mQuery::what_is_in_the_way() const {
  if (!best_) return "no way to retrieve the object was found yet";
  std::string text;
  for (ObjectId id : movables_) {
    if (best_->loads[id.index()].cells == 0) continue;
    text += (text.empty() ? "" : ", ") + problem_.scene[id].id;
    const auto causes = causes_.find(id);
    if (causes == causes_.end()) continue;
    std::string list;
    for (const auto& [cause, count] : causes->second)
      list += (list.empty() ? "" : ", ") + cause + " " + std::to_string(count);
    text += " (failed pushes: " + list + ")";
  }
  const std::string seen = std::to_string(vertices_.size()) + " rearrangements, " +
                           std::to_string(result_.stats.push_attempts) + " pushes tried; ";
  if (text.empty()) return seen + "the region to be cleared is free, but the retrieval was not found or not verified";
  return seen + "at best still in the way: " + text;
}

void Em4mQuery::count_failures(const std::map<std::string, std::int64_t>& failures, const std::string& prefix) {
  for (const auto& [cause, count] : failures) result_.stats.failures[prefix + cause] += count;
}

}  // namespace mamo
