// Forward kinematics of all links, the Jacobian, and inverse kinematics from random seeds of a PR2-like arm.
// Answers are checked before they are timed; the signature hashes them.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <ctime>

#include "support/robots.hpp"

#include "mamo/common/hash.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"

namespace {

using namespace mamo;

struct Data {
  Robot robot = fixtures::pr2_like_arm();
  ForwardKinematics kinematics{robot};
  InverseKinematics inverse{kinematics};
  std::vector<Eigen::VectorXd> q, seeds;
  std::vector<Eigen::Isometry3d> targets;
  Data() {
    RandomStream random(3, {});
    for (int k = 0; k < 2000; ++k) {
      q.push_back(fixtures::random_configuration(robot, random));
      seeds.push_back(fixtures::random_configuration(robot, random));
      targets.push_back(kinematics.tip_pose(q.back()));
    }
  }
};

const Data& data() {
  static const Data instance;
  return instance;
}

/// Processor time of this thread: neighbours on the same cores count less.
double now_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

/// Solves every target once: the answers checked, the share solved, percentiles of the time of one.
bool check_and_report() {
  const Data& d = data();
  HashStream hash;
  std::vector<double> us;
  int solved = 0;
  for (std::size_t k = 0; k < d.targets.size(); ++k) {
    const double begin = now_us();
    const auto q = d.inverse.solve(d.targets[k], d.seeds[k], k);
    us.push_back(now_us() - begin);
    if (!q) continue;
    ++solved;
    const auto [distance, angle] = pose_error(d.kinematics.tip_pose(*q), d.targets[k]);
    if (!(distance <= 1.001e-4) || !(angle <= 1.001e-3) || !d.robot.within_limits(*q)) return false;
    for (double x : *q) hash.add(x);
  }
  std::sort(us.begin(), us.end());
  benchmark::AddCustomContext("signature", to_hex(hash.value()));
  std::printf("ik solved %d/%zu, us 25%% %.0f 50%% %.0f 75%% %.0f 95%% %.0f\n", solved, us.size(), us[us.size() / 4],
              us[us.size() / 2], us[us.size() * 3 / 4], us[us.size() * 95 / 100]);
  return true;
}

void forward_all_links(benchmark::State& state) {
  const Data& d = data();
  std::vector<Eigen::Isometry3d> X_WL;
  std::size_t k = 0;
  for (auto _ : state) {
    d.kinematics.link_poses(d.q[k++ % d.q.size()], X_WL);
    benchmark::DoNotOptimize(X_WL.data());
  }
}
BENCHMARK(forward_all_links);

void jacobian(benchmark::State& state) {
  const Data& d = data();
  std::vector<Eigen::Isometry3d> X_WL;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J;
  d.kinematics.link_poses(d.q[0], X_WL);
  for (auto _ : state) {
    d.kinematics.jacobian(X_WL, J);
    benchmark::DoNotOptimize(J.data());
  }
}
BENCHMARK(jacobian);

void inverse_from_random_seed(benchmark::State& state) {
  const Data& d = data();
  std::size_t k = 0;
  for (auto _ : state) {
    const std::size_t i = k++ % d.targets.size();
    benchmark::DoNotOptimize(d.inverse.solve(d.targets[i], d.seeds[i], i));
  }
}
BENCHMARK(inverse_from_random_seed)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  if (!check_and_report()) {
    std::fprintf(stderr, "wrong answer: nothing timed\n");
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
