#include "verify/interaction_log.hpp"

#include <algorithm>
#include <tuple>

namespace mamo::verify {

bool InteractionLog::moved_by_robot(const World& world, ObjectId id) const {
  if (id == kRobot) return true;
  return caused_.contains(id) && world.awake(id) &&
         (world.linear_velocity(id).norm() > 1e-4 || world.angular_velocity(id).norm() > 1e-3);
}

void InteractionLog::note(const World& world, const std::vector<Contact>& contacts, double time_s) {
  // Chains form within one step: repeat until no pair is new. Contacts are sorted, so the result has one order.
  for (bool grew = true; grew;) {
    grew = false;
    for (const Contact& c : contacts) {
      if (c.a == c.b || c.a == kFloor || c.b == kFloor) continue;
      if ((c.a.valid() && scene_[c.a].fixture()) || (c.b.valid() && scene_[c.b].fixture())) continue;
      if (first_.contains({c.a, c.b}) || !(moved_by_robot(world, c.a) || moved_by_robot(world, c.b))) continue;
      first_[{c.a, c.b}] = time_s;
      for (ObjectId id : {c.a, c.b})
        if (id.valid()) caused_.insert(id);
      grew = true;
    }
  }
}

std::vector<Interaction> InteractionLog::interactions() const {
  std::vector<Interaction> list;
  for (const auto& [pair, time_s] : first_) list.push_back({pair.first, pair.second, time_s});
  std::sort(list.begin(), list.end(), [](const Interaction& x, const Interaction& y) {
    return std::tie(x.first_time_s, x.a, x.b) < std::tie(y.first_time_s, y.a, y.b);
  });
  return list;
}

}  // namespace mamo::verify
