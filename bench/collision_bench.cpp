// Edges of 7 configurations, a 10-link arm, 20 objects, self-collision on: the checker against a loop over bounding
// boxes with fcl::collide that looks at the same configurations. Both must give the same answers before they are timed.
#include <benchmark/benchmark.h>
#include <fcl/narrowphase/collision.h>

#include <cstdio>
#include <ctime>

#include "support/brute_force.hpp"
#include "support/robots.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"

namespace {

using namespace mamo;

constexpr std::size_t kConfigurations = 7;

struct Edge {
  Eigen::VectorXd q0, q1;
};

/// The baseline: pose everything, compare axis-aligned boxes, ask FCL; gripper first, out at the first hit.
class BoxLoop {
 public:
  BoxLoop(const Robot& robot, const Scene& scene) : kinematics_(robot) {
    const std::vector<bool> moves = robot.moving_links();
    for (std::size_t l = robot.model->links.size(); l-- > 0;)
      for (const PlacedShape& s : robot.model->links[l].collision)
        parts_.push_back({l, moves[l], &s.shape, s.X_BS, fixtures::fcl_shape(s.shape, 0), {}, {}});
    for (const auto& [a, b] : robot.self_pairs)
      for (std::size_t i = 0; i < parts_.size(); ++i)
        for (std::size_t k = 0; k < parts_.size(); ++k)
          if (parts_[i].link == a.index() && parts_[k].link == b.index()) self_.emplace_back(i, k);
    for (const Object& o : scene.objects) {
      for (const PlacedShape& s : o.shapes) {
        Body body{0, false, &s.shape, s.X_BS, fixtures::fcl_shape(s.shape, 0), o.X_WO * s.X_BS, {}};
        body.box = bounds(s.shape, body.X);
        objects_.push_back(body);
      }
    }
  }

  bool free(const Edge& edge) {
    for (int i : {3, 1, 5, 0, 2, 4, 6}) {
      const double s = i / 6.0;
      q_ = (1.0 - s) * edge.q0 + s * edge.q1;
      if (!free(q_)) return false;
    }
    return true;
  }

 private:
  struct Body {
    std::size_t link;
    bool moves;
    const Shape* shape;
    Eigen::Isometry3d X_LS;
    fixtures::FclShape geometry;
    Eigen::Isometry3d X;
    Eigen::AlignedBox3d box;
  };
  bool free(const Eigen::VectorXd& q) {
    kinematics_.link_poses(q, X_WL_);
    for (Body& p : parts_) {
      p.X = X_WL_[p.link] * p.X_LS;
      p.box = bounds(*p.shape, p.X);
    }
    for (const Body& p : parts_)
      if (p.moves)
        for (const Body& o : objects_)
          if (p.box.intersects(o.box) && hit(p, o)) return false;
    for (const auto& [a, b] : self_)
      if (parts_[a].box.intersects(parts_[b].box) && hit(parts_[a], parts_[b])) return false;
    return true;
  }
  bool hit(const Body& a, const Body& b) {
    fcl::CollisionResultd result;
    return fcl::collide(a.geometry.get(), a.X, b.geometry.get(), b.X, request_, result) > 0;
  }

  ForwardKinematics kinematics_;
  std::vector<Body> parts_, objects_;
  std::vector<std::pair<std::size_t, std::size_t>> self_;
  fcl::CollisionRequestd request_{1, false};
  std::vector<Eigen::Isometry3d> X_WL_;
  Eigen::VectorXd q_;
};

struct Bench {
  Robot robot = fixtures::pr2_like_arm();
  Scene scene = fixtures::cluttered_shelf(10, 5, 11);
  std::shared_ptr<ForwardKinematics> kinematics = std::make_shared<ForwardKinematics>(robot);
  CollisionChecker checker{kinematics, scene, {0.01, 0.003}};  // a step that makes these edges 7 configurations long
  CollisionChecker fine{kinematics, scene};                    // the default step: five times as many on the same edges
  BoxLoop loop{robot, scene};
  ObjectSet all{scene.size()}, none{scene.size()};
  CollisionReport report;
  std::vector<Edge> near_mix, near_free, uniform_mix, uniform_free;

  Bench() {
    for (std::size_t i = 0; i < scene.size(); ++i) all.insert(ObjectId(i));
    RandomStream random(17, {});
    const InverseKinematics inverse(*kinematics);
    for (std::uint64_t k = 0; near_mix.size() < 2000; ++k) {
      const double yaw = random.uniform(-0.8, 0.8);
      const Eigen::Isometry3d X =
          fixtures::at(random.uniform(0.45, 0.95), random.uniform(-0.85, -0.15), random.uniform(0.8, 1.05), yaw);
      const auto q = inverse.solve(X, fixtures::random_configuration(robot, random), k);
      if (q) near_mix.push_back(edge_from(*q, random));
    }
    while (uniform_mix.size() < 2000)
      uniform_mix.push_back(edge_from(fixtures::random_configuration(robot, random), random));
    for (const Edge& e : near_mix)
      if (free(e)) near_free.push_back(e);
    for (const Edge& e : uniform_mix)
      if (free(e)) uniform_free.push_back(e);
  }

  bool free(const Edge& e) { return checker.check_edge(e.q0, e.q1, all, none, report); }

  /// One joint (every other edge) or all of them, as far as 7 configurations allow.
  Edge edge_from(const Eigen::VectorXd& q, RandomStream& random) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(robot.dof());
    const bool one = random.below(2) == 0;
    for (int i = 0; i < robot.dof(); ++i) d[i] = one ? 0.0 : random.uniform(-1, 1);
    if (one) d[static_cast<int>(random.below(7))] = random.below(2) ? 1 : -1;
    double lower = 0, upper = 20;
    for (int k = 0; k < 60; ++k) {
      const double middle = (lower + upper) / 2;
      (checker.edge_samples(q, q + middle * d).size() <= kConfigurations ? lower : upper) = middle;
    }
    return {q, q + lower * d};
  }
};

Bench& bench() {
  static Bench instance;
  return instance;
}

/// Processor time of this thread: neighbours on the same cores count less.
double now_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class F>
double seconds(const F& run) {
  const double begin = now_s();
  run();
  return now_s() - begin;
}

/// Answers compared, then both timed in turn; the median of the paired ratios.
bool compare(const char* name, const std::vector<Edge>& edges, HashStream& hash) {
  Bench& b = bench();
  int free = 0;
  for (const Edge& e : edges) {
    if (b.checker.edge_samples(e.q0, e.q1).size() != kConfigurations) return false;
    const bool answer = b.free(e);
    if (answer != b.loop.free(e)) return false;
    hash.add(static_cast<std::int32_t>(answer));
    free += answer;
  }
  std::vector<double> ours, theirs, ratios, fine;
  for (int round = 0; round < 15; ++round) {
    ours.push_back(seconds([&] {
      for (const Edge& e : edges) benchmark::DoNotOptimize(b.free(e));
    }));
    theirs.push_back(seconds([&] {
      for (const Edge& e : edges) benchmark::DoNotOptimize(b.loop.free(e));
    }));
    ratios.push_back(theirs.back() / ours.back());
    fine.push_back(seconds([&] {
      for (const Edge& e : edges) benchmark::DoNotOptimize(b.fine.check_edge(e.q0, e.q1, b.all, b.none, b.report));
    }));
  }
  for (auto* v : {&ours, &theirs, &ratios, &fine}) std::sort(v->begin(), v->end());
  const double n = static_cast<double>(edges.size());
  std::printf(
      "%-20s %4zu edges, %3.0f %% free: %8.0f edges/s (box loop %7.0f), paired ratio %.1f [%.1f %.1f]; default step "
      "%8.0f\n",
      name, edges.size(), 100.0 * free / n, n / ours[7], n / theirs[7], ratios[7], ratios[3], ratios[11], n / fine[7]);
  return true;
}

void run_edges(benchmark::State& state, const std::vector<Edge>& edges) {
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(bench().free(edges[k++ % edges.size()]));
  state.SetItemsProcessed(state.iterations());
}
void near_shelf_free(benchmark::State& state) { run_edges(state, bench().near_free); }
void uniform_mix(benchmark::State& state) { run_edges(state, bench().uniform_mix); }
BENCHMARK(near_shelf_free);
BENCHMARK(uniform_mix);

void one_configuration(benchmark::State& state) {
  std::size_t k = 0;
  Bench& b = bench();
  for (auto _ : state) b.checker.check(b.near_free[k++ % b.near_free.size()].q0, b.all, true, b.report);
}
BENCHMARK(one_configuration);

void set_state_of_all_objects(benchmark::State& state) {
  Bench& b = bench();
  WorldState moved = WorldState::start_of(b.scene);
  for (auto _ : state) {
    for (auto& pose : moved.poses) pose.p[0] ^= 1;
    b.checker.set_state(moved);
  }
  b.checker.set_state(WorldState::start_of(b.scene));
}
BENCHMARK(set_state_of_all_objects);

}  // namespace

int main(int argc, char** argv) {
  Bench& b = bench();
  HashStream hash;
  const bool right = compare("near the shelf, mix", b.near_mix, hash) &&
                     compare("near the shelf, free", b.near_free, hash) &&
                     compare("uniform, mix", b.uniform_mix, hash) && compare("uniform, free", b.uniform_free, hash);
  if (!right) {
    std::fprintf(stderr, "the checker and the box loop disagree: nothing timed\n");
    return 1;
  }
  benchmark::AddCustomContext("signature", to_hex(hash.value()));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
