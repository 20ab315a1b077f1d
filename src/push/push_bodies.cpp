#include "push/push_bodies.hpp"

namespace mamo::push {

PushBodies push_bodies(const Problem& problem) {
  const Scene& scene = problem.scene;
  PushBodies bodies{ObjectSet(scene.size()), ObjectSet(scene.size()), ObjectSet(scene.size()), ObjectSet::all(scene),
                    kNoObject};
  if (const auto* retrieve = std::get_if<Retrieve>(&problem.task)) bodies.untouchable = retrieve->object;
  if (const auto* reach = std::get_if<ReachPose>(&problem.task)) bodies.untouchable = reach->target;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const ObjectId id(i);
    const Object& object = scene[id];
    const bool may_touch = id != bodies.untouchable && robot_may_touch(object.constraints.touch);
    if (!may_touch) bodies.forbidden.insert(id);
    if (object.fixture()) continue;
    (may_touch ? bodies.movable : bodies.standing).insert(id);
  }
  return bodies;
}

}  // namespace mamo::push
