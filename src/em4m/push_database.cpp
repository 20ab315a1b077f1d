#include "em4m/push_database.hpp"

#include <algorithm>
#include <cmath>

namespace mamo {

PushDatabase::Key PushDatabase::key_of(const ObjectPath& path) {
  Key key{path.object, {}};
  for (const Eigen::Vector2d& p : path.points)
    key.second.push_back(
        {static_cast<std::int32_t>(std::lround(p.x() * 1e6)), static_cast<std::int32_t>(std::lround(p.y() * 1e6))});
  return key;
}

void PushDatabase::store(const ObjectPath& path, const WorldState& before, std::shared_ptr<const PushOutcome> push) {
  entries_[key_of(path)].push_back({before, std::move(push)});
}

std::shared_ptr<const PushOutcome> PushDatabase::find(const ObjectPath& path, const WorldState& state,
                                                      const std::vector<ObjectId>& movables,
                                                      PushPlanner& planner) const {
  const auto known = entries_.find(key_of(path));
  if (known == entries_.end()) return nullptr;
  for (const Entry& entry : known->second) {
    const std::vector<ObjectId>& moved = entry.push->moved;
    if (!std::ranges::all_of(moved, [&](ObjectId id) { return entry.before[id] == state[id]; })) continue;
    ObjectSet others(state.poses.size());
    for (ObjectId id : movables)
      if (std::ranges::find(moved, id) == moved.end()) others.insert(id);
    if (planner.reusable(*entry.push, state, others)) return entry.push;
  }
  return nullptr;
}

WorldState PushDatabase::after(const PushOutcome& push, const WorldState& state) {
  WorldState out = state;
  for (ObjectId id : push.moved) out[id] = push.after[id];
  return out;
}

}  // namespace mamo
