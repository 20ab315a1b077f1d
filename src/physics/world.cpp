#include "mamo/physics/world.hpp"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <optional>
#include <stdexcept>

#include "physics/body.hpp"
#include "physics/contact_pairs.hpp"

namespace mamo {
namespace {

constexpr double kFloorFriction = 0.8;  // coefficient
constexpr double kWakeDistance = 1e-3;  // m, between boxes

btContactSolverInfo solver_settings(const PhysicsSettings& physics) {
  btContactSolverInfo info;
  info.m_timeStep = physics.step;
  info.m_numIterations = physics.iterations;
  info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD | SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
  return info;
}

double floor_height(const Scene& scene) {
  double z = 0;
  for (const Object& o : scene.objects)
    for (const PlacedShape& s : o.shapes) z = std::min(z, bounds(s.shape, o.X_WO * s.X_BS).min().z());
  return z;
}

}  // namespace

// One step, in this order: the arm's velocities; gravity on what is awake; pairs near each other get contact
// points; a contact with something that moves wakes a sleeper; velocities are solved; poses follow, the arm's too;
// what has rested long enough goes to sleep. Invariants: `driven` and `free` hold indices of present bodies, ascending;
// a body asleep has velocity zero and has not moved since it fell asleep or was placed.
struct World::Impl {
  std::shared_ptr<const ForwardKinematics> kinematics;
  PhysicsSettings physics;
  std::vector<Body> bodies;      // the floor, links with shapes, all objects by id
  std::size_t first_object = 0;  // body of object 0
  std::vector<int> driven, free;
  std::unique_ptr<ContactPairs> pairs;
  btSequentialImpulseConstraintSolver solver;
  btContactSolverInfo info;
  std::vector<bool> fixture;  // by object id
  ObjectSet present;
  WorldState rest;  // where each object fell asleep last, or as given to reset
  std::int64_t steps = 0;
  int sleep_after = 0;  // steps
  ObjectSet took_part;
  std::vector<std::optional<Bounds>> swept;  // by body
  // Scratch of one step.
  std::vector<Eigen::Isometry3d> X_WL;
  std::vector<std::uint32_t> near;
  std::vector<double> travel;
  std::vector<btCollisionObject*> awake_bodies;
  std::vector<btPersistentManifold*> manifolds;

  Impl(std::shared_ptr<const ForwardKinematics> kin, const Scene& scene)
      : kinematics(std::move(kin)), physics(scene.physics), info(solver_settings(scene.physics)) {
    sleep_after = static_cast<int>(std::lround(kSleepTime / physics.step));
    bodies.emplace_back(floor_height(scene), kFloorFriction);
    add_links();
    first_object = bodies.size();
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const Object& o = scene.objects[i];
      fixture.push_back(o.fixture());
      bodies.emplace_back(o.shapes, o.X_WO, ObjectId(i), o.fixture() ? 0.0 : o.mass, o.friction);
    }
    std::vector<btCollisionObject*> objects;
    for (const Body& b : bodies) {
      b.bullet()->setWorldArrayIndex(static_cast<int>(objects.size()));
      objects.push_back(b.bullet());
    }
    pairs = std::make_unique<ContactPairs>(objects);
    travel.resize(bodies.size());
  }

  void add_links() {
    const Robot& robot = kinematics->robot();
    const std::vector<bool> moving = robot.moving_links();
    kinematics->link_poses(robot.group_part(robot.posture), X_WL);
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const Link& link = robot.model->links[i];
      if (link.collision.empty()) continue;
      Body& b = bodies.emplace_back(link.collision, X_WL[i], kRobot, 0.0, physics.robot_friction);
      if (moving[i]) b.attach_to(LinkId(i), Eigen::Isometry3d::Identity());
    }
  }

  void reset(const ObjectSet& wanted, const WorldState& state, const Eigen::VectorXd& q) {
    pairs->clear();
    solver.reset();
    present = wanted;
    rest = state;
    steps = 0;
    took_part = ObjectSet(fixture.size());
    swept.assign(bodies.size(), std::nullopt);
    driven.clear();
    free.clear();
    kinematics->link_poses(q, X_WL);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Body& b = bodies[i];
      if (i < first_object) {
        if (b.role() == Role::driven) b.place(X_WL[b.link().index()]);
      } else if (!fixture[i - first_object]) {
        b.present = wanted.contains(b.id());
        if (!b.present) continue;
        b.place(state.X_WO(b.id()));
      }
      if (b.role() == Role::driven) driven.push_back(static_cast<int>(i));
      if (b.role() == Role::free) free.push_back(static_cast<int>(i));
    }
  }

  Body& at(int i) { return bodies[static_cast<std::size_t>(i)]; }
  Body& of(ObjectId id) {
    if (!present.contains(id)) throw std::invalid_argument("World: the object is not present");
    return bodies[first_object + id.index()];
  }

  void add_near(int a, int b) {
    if (at(a).bounds().overlaps(at(b).bounds())) near.push_back(pairs->key(std::min(a, b), std::max(a, b)));
  }

  /// An awake body with anything, a moving link with any free body.
  void find_near() {
    near.clear();
    for (const int f : free) {
      const Body& body = at(f);
      if (!body.awake()) {
        for (const int d : driven)
          if (at(d).moving() && !body.ignores_robot) add_near(d, f);
        continue;
      }
      for (int o = 0; o < static_cast<int>(bodies.size()); ++o) {
        const Body& other = at(o);
        const bool found_from_other = other.awake() && o <= f;
        if (!other.present || found_from_other || (body.ignores_robot && other.name() == kRobot)) continue;
        add_near(f, o);
      }
    }
    std::sort(near.begin(), near.end());
  }

  void record_sweep(int i) {
    const Bounds& now = at(i).bounds();
    std::optional<Bounds>& all = swept[static_cast<std::size_t>(i)];
    if (!all) all = now;
    for (std::size_t k = 0; k < 3; ++k) {
      all->min[k] = std::min(all->min[k], now.min[k]);
      all->max[k] = std::max(all->max[k], now.max[k]);
    }
  }
  /// Of what moves, exactly the boxes that find_near() goes by.
  void record_sweeps() {
    for (const int d : driven)
      if (at(d).moving()) record_sweep(d);
    for (const int f : free)
      if (at(f).awake()) record_sweep(f);
  }
  void record_participants() {
    for (const int f : free)
      if (at(f).awake()) took_part.insert(at(f).id());
    for (const ContactPairs::Pair* p : pairs->visited()) {
      if (p->points == 0) continue;
      for (const int i : {pairs->first(*p), pairs->second(*p)})
        if (at(i).id().valid()) took_part.insert(at(i).id());
    }
  }

  void collide() {
    for (std::size_t i = 0; i < bodies.size(); ++i) travel[i] = bodies[i].travel();
    pairs->collide(near, travel, physics.step);
  }

  void wake_near() {
    const auto sleeps = [](const Body& b) { return b.role() == Role::free && !b.awake(); };
    for (const ContactPairs::Pair* p : pairs->visited()) {
      Body &a = at(pairs->first(*p)), &b = at(pairs->second(*p));
      if (!sleeps(a) && !sleeps(b)) continue;
      // Two boxes get contact points only once they overlap, so that what lies on one could hover when it goes.
      const bool close = p->points > 0 || (a.has_box() && b.has_box() &&
                                           pairs->distance(pairs->first(*p), pairs->second(*p), kWakeDistance) < 1);
      if (!close) continue;
      if (sleeps(a)) a.wake();
      if (sleeps(b)) b.wake();
    }
  }

  void solve() {
    awake_bodies.clear();
    manifolds.clear();
    for (const int f : free)
      if (at(f).awake()) awake_bodies.push_back(at(f).bullet());
    if (awake_bodies.empty()) return;
    for (const ContactPairs::Pair* p : pairs->visited())
      if (p->points > 0) manifolds.insert(manifolds.end(), p->manifolds.begin(), p->manifolds.end());
    solver.solveGroup(awake_bodies.data(), static_cast<int>(awake_bodies.size()), manifolds.data(),
                      static_cast<int>(manifolds.size()), nullptr, 0, info, nullptr, pairs->dispatcher());
  }

  /// Restlessness spreads along contacts; what it does not reach goes to sleep.
  void let_sleep() {
    const auto rested = [&](const Body& b) { return b.awake() && b.rest_steps() >= sleep_after; };
    if (std::none_of(free.begin(), free.end(), [&](int f) { return rested(at(f)); })) return;
    const auto disturb = [&](Body& b, const Body& by) {
      if (!rested(b) || !by.active() || rested(by)) return false;
      b.limit_rest(sleep_after - 1);
      return true;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (const ContactPairs::Pair* p : pairs->visited()) {
        if (p->points == 0) continue;
        Body &a = at(pairs->first(*p)), &b = at(pairs->second(*p));
        changed = disturb(a, b) || disturb(b, a) || changed;
      }
    }
    for (const int f : free)
      if (rested(at(f))) fall_asleep(at(f));
    pairs->drop([this](int a, int b) { return !at(a).active() && !at(b).active(); });
  }

  void fall_asleep(Body& b) {
    const Eigen::Isometry3d X_WO = b.X_WB(), X_WO_before = rest.X_WO(b.id());
    const Eigen::AngleAxisd turn(X_WO_before.linear().transpose() * X_WO.linear());
    const bool trembled = (X_WO.translation() - X_WO_before.translation()).norm() < kTrembleDistance &&
                          std::abs(turn.angle()) < kTrembleAngle;
    if (!trembled) rest[b.id()] = quantise(X_WO);
    b.put_to_sleep(rest.X_WO(b.id()));
  }

  void step(const Eigen::VectorXd& q) {
    ++steps;
    kinematics->link_poses(q, X_WL);
    for (const int d : driven) at(d).drive(X_WL[at(d).link().index()], 1.0 / physics.step);
    for (const int f : free)
      if (at(f).awake()) at(f).apply_gravity();
    find_near();
    record_sweeps();
    collide();
    pairs->forget([this](int a, int b) { return at(a).active() || at(b).active(); });
    wake_near();
    record_participants();
    solve();
    for (const int d : driven) at(d).arrive(X_WL[at(d).link().index()]);
    for (const int f : free)
      if (at(f).awake()) at(f).integrate(physics.step);
    let_sleep();
  }
};

World::World(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene)
    : impl_(std::make_unique<Impl>(std::move(kinematics), scene)) {}
World::~World() = default;

void World::reset(const ObjectSet& present, const WorldState& state, const Eigen::VectorXd& q) {
  impl_->reset(present, state, q);
}

void World::step(const Eigen::VectorXd& q) { impl_->step(q); }

double World::time_s() const { return static_cast<double>(impl_->steps) * impl_->physics.step; }
const ObjectSet& World::present() const { return impl_->present; }

Eigen::Isometry3d World::X_WO(ObjectId id) const {
  const Body& b = impl_->of(id);
  return b.role() == Role::driven || b.awake() ? b.X_WB() : impl_->rest.X_WO(id);
}
const QuantisedPose& World::rest_pose(ObjectId id) const {
  impl_->of(id);
  return impl_->rest[id];
}
Eigen::Vector3d World::linear_velocity(ObjectId id) const { return impl_->of(id).linear_velocity(); }
Eigen::Vector3d World::angular_velocity(ObjectId id) const { return impl_->of(id).angular_velocity(); }
bool World::awake(ObjectId id) const { return impl_->of(id).active(); }

const ObjectSet& World::took_part() const { return impl_->took_part; }

std::vector<Eigen::AlignedBox3d> World::swept() const {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const std::optional<Bounds>& b : impl_->swept)
    if (b)
      boxes.emplace_back(Eigen::Map<const Eigen::Vector3d>(b->min.data()),
                         Eigen::Map<const Eigen::Vector3d>(b->max.data()));
  return boxes;
}

World::Ball World::ball(ObjectId id) const { return impl_->bodies[impl_->first_object + id.index()].ball(); }

void World::contacts(std::vector<Contact>& out) const {
  out.clear();
  Impl& w = *impl_;
  for (const ContactPairs::Pair* p : w.pairs->live()) {
    const std::optional<ContactPairs::TouchPoint> touch = ContactPairs::touch_point(*p);
    if (!touch) continue;
    const ObjectId a = w.at(w.pairs->first(*p)).name(), b = w.at(w.pairs->second(*p)).name();
    out.push_back({std::min(a, b), std::max(a, b), touch->depth, touch->p_W});
  }
  // Several links may touch one object: the deepest stays.
  std::sort(out.begin(), out.end(), [](const Contact& x, const Contact& y) {
    return std::tie(x.a, x.b, y.depth) < std::tie(y.a, y.b, x.depth);
  });
  const auto same = [](const Contact& x, const Contact& y) { return x.a == y.a && x.b == y.b; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

void World::wake(ObjectId id) {
  if (impl_->of(id).role() == Role::free) impl_->of(id).wake();
}

void World::attach(ObjectId id, LinkId link) {
  Impl& w = *impl_;
  const Eigen::Isometry3d X_WO = this->X_WO(id);
  Body& body = w.of(id);
  if (body.role() == Role::driven) throw std::invalid_argument("World: the object is held already");
  body.attach_to(link, w.X_WL[link.index()].inverse() * X_WO);
  const int index = static_cast<int>(w.first_object + id.index());
  std::erase(w.free, index);
  w.driven.insert(std::lower_bound(w.driven.begin(), w.driven.end(), index), index);
  // Its contacts end here: with what is static for good, with free bodies until they are found anew.
  w.near.clear();
  w.collide();
  w.pairs->forget([index](int a, int b) { return a == index || b == index; });
}

void World::ignore_robot(ObjectId id) {
  impl_->of(id).ignores_robot = true;
  const int index = static_cast<int>(impl_->first_object + id.index());
  Impl& w = *impl_;
  w.near.clear();
  w.collide();
  w.pairs->forget([&w, index](int a, int b) { return b == index && w.at(a).name() == kRobot; });
}

std::vector<std::pair<ObjectId, ObjectId>> World::touching(const WorldState& state, double tolerance) {
  Impl& w = *impl_;
  w.reset(ObjectSet(w.fixture.size()), state, w.kinematics->robot().group_part(w.kinematics->robot().posture));
  std::vector<std::pair<ObjectId, ObjectId>> out;
  for (std::size_t i = w.first_object; i < w.bodies.size(); ++i)
    if (!w.fixture[i - w.first_object]) w.bodies[i].place(state.X_WO(w.bodies[i].id()));
  for (int a = 0; a < static_cast<int>(w.bodies.size()); ++a)
    for (int b = std::max(a + 1, static_cast<int>(w.first_object)); b < static_cast<int>(w.bodies.size()); ++b) {
      const bool a_fixed = a == 0 || (w.at(a).id().valid() && w.fixture[w.at(a).id().index()]);
      if (w.at(a).id() == kRobot || (a_fixed && w.fixture[w.at(b).id().index()])) continue;
      if (!w.at(a).bounds().overlaps(w.at(b).bounds())) continue;
      if (w.pairs->distance(a, b, tolerance) < tolerance) out.emplace_back(w.at(a).id(), w.at(b).id());
    }
  return out;
}

}  // namespace mamo
