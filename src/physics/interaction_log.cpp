#include "physics/interaction_log.hpp"

#include <algorithm>
#include <tuple>

#include "mamo/physics/evaluation.hpp"

namespace mamo {

InteractionLog::InteractionLog(const Scene& scene) : begin_(scene.size()) {
  for (const Object& o : scene.objects) {
    fixture_.push_back(o.fixture());
    centre_.push_back(o.centre_of_mass());
  }
}

void InteractionLog::begin(const WorldState& state) {
  from_ = state;
  influenced_.assign(fixture_.size(), false);
  interactions_.clear();
}

bool InteractionLog::moves(const World& world, ObjectId id) const {
  if (id == kRobot) return true;
  if (!influenced_[id.index()]) return false;
  if (world.linear_velocity(id).norm() > kMovedSpeed) return true;
  return (world.X_WO(id) * centre_[id.index()] - begin_[id.index()]).norm() > kMovedDistance;
}

void InteractionLog::note(const World& world, const std::vector<Contact>& contacts, double time_s) {
  const std::size_t before = interactions_.size();
  const auto influence = [&](ObjectId id) {
    if (!id.valid() || influenced_[id.index()]) return;
    influenced_[id.index()] = true;
    begin_[id.index()] = from_.X_WO(id) * centre_[id.index()];
  };
  for (bool grew = true; grew;) {  // chains form within one step
    grew = false;
    for (const Contact& c : contacts) {
      if (!is_node(c.a) || !is_node(c.b)) continue;
      const auto same = [&](const Interaction& i) { return i.a == c.a && i.b == c.b; };
      if (std::any_of(interactions_.begin(), interactions_.end(), same)) continue;
      if (!moves(world, c.a) && !moves(world, c.b)) continue;
      interactions_.push_back({c.a, c.b, time_s});
      influence(c.a);
      influence(c.b);
      grew = true;
    }
  }
  std::sort(interactions_.begin() + static_cast<std::ptrdiff_t>(before), interactions_.end(),
            [](const Interaction& x, const Interaction& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
}

}  // namespace mamo
