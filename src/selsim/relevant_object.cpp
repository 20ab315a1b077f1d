#include "mamo/selsim/relevant_object.hpp"

#include <deque>
#include <set>

namespace mamo {

ObjectId relevant_object(const std::vector<Interaction>& interactions, ObjectId violated, const ObjectSet& relevant,
                         const Scene& scene) {
  const auto node = [&](ObjectId id) { return id.valid() && !scene[id].fixture(); };
  if (!node(violated)) return kNoObject;
  std::deque<ObjectId> queue{violated};
  std::set<ObjectId> explored{violated};
  while (!queue.empty()) {
    const ObjectId s = queue.front();
    queue.pop_front();
    if (!relevant.contains(s)) return s;
    std::vector<std::pair<double, ObjectId>> next;
    for (const Interaction& pair : interactions) {
      const ObjectId other = pair.a == s ? pair.b : pair.b == s ? pair.a : kNoObject;
      if (node(other) && !explored.contains(other)) next.emplace_back(pair.first_time_s, other);
    }
    std::sort(next.begin(), next.end());
    for (const auto& [time, id] : next)
      if (explored.insert(id).second) queue.push_back(id);
  }
  return kNoObject;
}

}  // namespace mamo
