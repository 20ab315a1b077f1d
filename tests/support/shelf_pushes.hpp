// Contact-rich pushes through a cluttered shelf, by a gantry whose finger is a whole gripper.
#pragma once

#include <vector>

#include "mamo/physics/evaluation.hpp"
#include "support/pusher.hpp"

namespace mamo::pushing {

inline std::shared_ptr<const ForwardKinematics> gripper_gantry() {
  return gantry({{Box{{0.096, 0.101, 0.049}}, at(-0.12, 0, 0)},
                 {Box{{0.104, 0.03, 0.04}}, at(-0.03, 0.03, 0)},
                 {Box{{0.104, 0.03, 0.04}}, at(-0.03, -0.03, 0)}});
}

/// Touching anything is allowed: pushes run to their ends.
inline Scene permissive_shelf(int movables, int immovables, std::uint64_t seed) {
  Scene scene = fixtures::cluttered_shelf(movables, immovables, seed);
  for (Object& o : scene.objects) o.constraints.touch = o.fixture() ? Touch::support : Touch::allowed;
  return scene;
}

/// Into the shelf by way of two random points, deep among the objects.
inline TimedPath random_push(RandomStream& random, double step_s, double speed = 0.2) {
  const double z = random.uniform(0.79, 0.83), y = random.uniform(-0.75, -0.25);
  const Eigen::Vector3d mouth(0.4, y, z);
  const Eigen::Vector3d inside(random.uniform(0.6, 0.8), y + random.uniform(-0.08, 0.08), z);
  const Eigen::Vector3d deep(inside.x() + random.uniform(0.0, 0.1), inside.y() + random.uniform(-0.15, 0.15), z);
  return along({mouth, inside, deep}, step_s, speed);
}

/// One thing to compute: objects present, where they are, how the gantry moves.
struct Push {
  ObjectSet present;
  WorldState from;
  TimedPath motion;
};

/// Pushes from the start and from what earlier pushes left behind, with random sets of objects.
inline std::vector<Push> random_pushes(const Scene& scene, int count, std::uint64_t seed) {
  RandomStream random(seed, {0x70757368});
  Evaluator evaluator(gripper_gantry(), scene);
  std::vector<WorldState> states = {WorldState::start_of(scene)};
  std::vector<Push> pushes;
  while (static_cast<int>(pushes.size()) < count) {
    Push push{ObjectSet::all(scene), states[random.below(states.size())], random_push(random, scene.physics.step)};
    if (random.uniform() < 0.7)
      for (const ObjectId id : ObjectSet::all(scene).ids())
        if (random.uniform() < 0.3) push.present.erase(id);
    EvaluationRequest request;
    request.present = &push.present;
    request.from = &push.from;
    request.motion = &push.motion;
    const Evaluation e = evaluator.evaluate(request);
    if (!e.second_order) continue;  // objects must push objects
    if (e.valid && states.size() < 6) states.push_back(e.state);
    pushes.push_back(std::move(push));
  }
  return pushes;
}

/// The configurations after each step of the motion.
inline std::vector<Eigen::VectorXd> sampled(const TimedPath& motion, double step_s) {
  std::vector<Eigen::VectorXd> out(static_cast<std::size_t>(std::lround(motion.duration() / step_s)));
  for (std::size_t k = 0; k < out.size(); ++k) motion.at(static_cast<double>(k + 1) * step_s, out[k]);
  return out;
}

/// Steps a world that was reset; hashes every pose, velocity and contact after every step, bit for bit.
inline std::uint64_t step_bits(World& world, const std::vector<Eigen::VectorXd>& path) {
  HashStream bits;
  const std::vector<ObjectId> ids = world.present().ids();
  std::vector<Contact> contacts;
  for (const Eigen::VectorXd& q : path) {
    world.step(q);
    world.contacts(contacts);
    for (const Contact& c : contacts) bits.add(c.a.value), bits.add(c.b.value), bits.add(c.depth);
    for (const ObjectId id : ids) {
      if (!world.awake(id)) continue;
      const Eigen::Isometry3d X = world.X_WO(id);
      for (int i = 0; i < 12; ++i) bits.add(X.matrix()(i % 3, i / 3));
      for (int i = 0; i < 3; ++i) bits.add(world.linear_velocity(id)[i]), bits.add(world.angular_velocity(id)[i]);
    }
  }
  return bits.value();
}

/// A push run to its end whatever happens.
inline std::uint64_t run_bits(World& world, const Push& push, double step_s) {
  world.reset(push.present, push.from, push.motion.q.front());
  return step_bits(world, sampled(push.motion, step_s));
}

}  // namespace mamo::pushing
