// A 2.5 s push of the full arm among 15 movables and 5 immovables on the shelf, without early exit, against the
// naive reference on the same pushes in turn; and the reset of a world. Answers are checked before they are timed.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cstdio>

#include "naive_bullet.hpp"
#include "support/arm_pushes.hpp"

#include "mamo/common/hash.hpp"

namespace {

using namespace mamo;
using pushing::ArmPush;

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Data {
  std::shared_ptr<const ForwardKinematics> kinematics = std::make_shared<ForwardKinematics>(fixtures::pr2_like_arm());
  struct Case {
    Scene scene;
    WorldState start;
    ArmPush push;
    std::unique_ptr<World> coarse, fine;  // default settings; 240 Hz and 50 iterations
  };
  std::vector<Case> cases;

  Data() {
    for (std::uint64_t seed = 1; cases.size() < 24 && seed < 40; ++seed) {
      const Scene scene = fixtures::cluttered_shelf(15, 5, seed);
      if (scene.size() != 25) continue;
      Scene fine = scene;
      fine.physics.step = 1.0 / 240;
      fine.physics.iterations = 50;
      for (const ArmPush& push : pushing::arm_pushes(kinematics, scene, 3, seed))
        cases.push_back({scene, WorldState::start_of(scene), push, std::make_unique<World>(kinematics, scene),
                         std::make_unique<World>(kinematics, fine)});
    }
  }
};

Data& data() {
  static Data instance;
  return instance;
}

/// Resets, pushes, reads the contacts of every step as an evaluation does.
void run(World& world, const Data::Case& c, double step_s) {
  world.reset(ObjectSet::all(c.scene), c.start, c.push.q.front());
  std::vector<Contact> contacts;
  const int steps = static_cast<int>(std::lround(ArmPush::kDuration / step_s));
  for (int k = 1; k <= steps; ++k) {
    world.step(c.push.at(k * step_s));
    world.contacts(contacts);
    benchmark::DoNotOptimize(contacts.data());
  }
}

Eigen::Vector3d run_naive(const Data::Case& c) {
  bench::NaiveBullet world(*data().kinematics, c.scene, c.push.q.front());
  for (int k = 1; k <= 600; ++k) world.step(c.push.at(k / 240.0));
  return world.position(c.push.object);
}

/// The pushed object moves in every variant, the same push gives the same bits twice.
bool check_and_sign() {
  HashStream hash;
  std::size_t awake = 0;
  for (Data::Case& c : data().cases) {
    const Eigen::Vector3d from = c.scene[c.push.object].X_WO.translation();
    for (World* world : {c.coarse.get(), c.fine.get()}) {
      std::uint64_t bits[2];
      for (std::uint64_t& b : bits) {
        run(*world, c, world == c.coarse.get() ? 1.0 / 120 : 1.0 / 240);
        HashStream h;
        for (const ObjectId id : ObjectSet::all(c.scene).ids())
          for (int i = 0; i < 3; ++i) h.add(world->X_WO(id).translation()[i]);
        b = h.value();
      }
      if (bits[0] != bits[1]) return std::puts("a push does not repeat"), false;
      if ((world->X_WO(c.push.object).translation() - from).norm() < 0.01) return std::puts("nothing moved"), false;
      hash.add(bits[0]);
    }
    for (const ObjectId id : ObjectSet::all(c.scene).ids()) awake += c.coarse->awake(id);
    if ((run_naive(c) - from).norm() < 0.01) return std::puts("nothing moved in the reference"), false;
  }
  benchmark::AddCustomContext("signature", to_hex(hash.value()));
  std::printf("%zu pushes, %.1f objects awake at the end\n", data().cases.size(),
              static_cast<double>(awake) / static_cast<double>(data().cases.size()));
  return data().cases.size() >= 20;
}

void report(const char* name, std::vector<double> v, const char* unit) {
  std::sort(v.begin(), v.end());
  const auto at = [&](double p) { return v[static_cast<std::size_t>(p * static_cast<double>(v.size() - 1))]; };
  std::printf("%-34s 25%% %8.2f  50%% %8.2f  75%% %8.2f %s\n", name, at(0.25), at(0.5), at(0.75), unit);
}

/// All variants in turn on each push: ratios are of neighbours in time.
void paired(int rounds) {
  std::vector<double> naive, coarse, fine, reset, to_coarse, to_fine, reset_share;
  for (int round = 0; round < rounds; ++round)
    for (Data::Case& c : data().cases) {
      const double t0 = cpu_s();
      run_naive(c);
      const double t1 = cpu_s();
      run(*c.coarse, c, 1.0 / 120);
      const double t2 = cpu_s();
      run(*c.fine, c, 1.0 / 240);
      const double t3 = cpu_s();
      const ObjectSet all = ObjectSet::all(c.scene);
      const double t4 = cpu_s();
      for (int k = 0; k < 20; ++k) c.coarse->reset(all, c.start, c.push.q.front());
      const double t5 = cpu_s();
      naive.push_back(1e3 * (t1 - t0)), coarse.push_back(1e3 * (t2 - t1)), fine.push_back(1e3 * (t3 - t2));
      reset.push_back(1e6 * (t5 - t4) / 20);
      to_coarse.push_back((t1 - t0) / (t2 - t1)), to_fine.push_back((t1 - t0) / (t3 - t2));
      reset_share.push_back(100 * (t5 - t4) / 20 / (t2 - t1));
    }
  report("naive 240 Hz 50 it", naive, "ms");
  report("default 120 Hz 20 it", coarse, "ms");
  report("240 Hz 50 it", fine, "ms");
  report("reset", reset, "us");
  report("naive / default", to_coarse, "x   (goal 12)");
  report("naive / 240 Hz 50 it", to_fine, "x   (goal 4.5)");
  report("reset / push with default settings", reset_share, "%   (goal 2)");
}

void push_default(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    Data::Case& c = data().cases[i++ % data().cases.size()];
    run(*c.coarse, c, 1.0 / 120);
  }
  state.SetItemsProcessed(state.iterations() * std::lround(ArmPush::kDuration * 120));  // steps
}
BENCHMARK(push_default)->Unit(benchmark::kMillisecond);

void step_while_all_sleep(benchmark::State& state) {
  Data::Case& c = data().cases.front();
  c.coarse->reset(ObjectSet::all(c.scene), c.start, c.push.q.front());
  Eigen::VectorXd q = data().kinematics->robot().group_part(data().kinematics->robot().posture);
  for (auto _ : state) q[0] += 1e-9, c.coarse->step(q);
}
BENCHMARK(step_while_all_sleep)->Unit(benchmark::kMicrosecond);

void reset(benchmark::State& state) {
  Data::Case& c = data().cases.front();
  const ObjectSet all = ObjectSet::all(c.scene);
  for (auto _ : state) c.coarse->reset(all, c.start, c.push.q.front());
}
BENCHMARK(reset)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (!check_and_sign()) return 1;
  paired(3);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
