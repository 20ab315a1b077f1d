// Attempts at pushes on the published shelf scenes: what becomes of them, by cause, and what each stage costs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "support/push_chain.hpp"
#include "support/shared_data.hpp"

#include "mamo/common/cpu_time.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/io/load.hpp"
#include "mamo/push/push_planner.hpp"

namespace {

using namespace mamo;

struct Place {
  Problem problem;
  std::shared_ptr<const ForwardKinematics> kinematics;
  std::unique_ptr<PushPlanner> planner;
  std::vector<PushRequest> requests;
};

/// Would the object, upright and turned as it is, overlap what stays when it is at p?
bool blocked(const Problem& problem, CollisionChecker& checker, ObjectId object, const Eigen::Vector2d& p) {
  WorldState state = WorldState::start_of(problem.scene);
  Eigen::Isometry3d X = state.X_WO(object);
  X.translation().head<2>() = p;
  state[object] = quantise(X);
  checker.set_state(state);
  for (const auto& [a, b] : checker.overlapping_objects(0.001))
    if ((a == object && !problem.scene[b].movable() && b.index() != 0) ||
        (b == object && !problem.scene[a].movable() && a.index() != 0))
      return true;
  return false;
}

/// Sideways and backwards, 5 to 20 cm, where nothing that stays is in the way.
void add_requests(Place& place, int attempts) {
  const Problem& problem = place.problem;
  const WorldState start = WorldState::start_of(problem.scene);
  for (const ObjectId id : ObjectSet::of_kind(problem.scene, ObjectKind::movable).ids()) {
    if (std::get<Retrieve>(problem.task).object == id) continue;
    const Eigen::Vector2d p = problem.scene[id].X_WO.translation().head<2>();
    if (p.x() > 0.85) continue;  // near the front or in the middle
    for (const double heading : {0.0, 0.5, -0.5, 1.57, -1.57, 2.2, -2.2}) {
      for (const double length : {0.05, 0.1, 0.2}) {
        const Eigen::Vector2d d(std::cos(heading), std::sin(heading));
        bool free = true;
        for (int k = 1; k <= 4; ++k)
          free = free && !blocked(problem, place.planner->collision(), id, p + d * (length * k / 4));
        const Eigen::Vector2d end = p + d * length;
        free = free && end.x() > 0.5 && end.x() < 1.06 && end.y() > -0.88 && end.y() < -0.12;
        if (!free) continue;
        PushRequest request;
        request.object = id;
        request.path = {p, end};
        request.state = start;
        for (request.attempt = 0; request.attempt < attempts; ++request.attempt) place.requests.push_back(request);
      }
    }
  }
}

std::optional<Place> load(const std::string& path) {
  io::LoadOptions options;
  Result<Problem> problem = io::load_problem(path, options);
  if (!problem.ok()) return std::nullopt;
  Place place;
  place.problem = std::move(*problem);
  choose_self_pairs(place.problem.robot, place.problem.robot_files.disabled, !place.problem.robot_files.srdf.empty(),
                    1);
  place.kinematics = std::make_shared<ForwardKinematics>(place.problem.robot);
  return place;
}

struct Sums {
  std::map<std::string, int> causes;
  std::vector<double> ms;
  PushTimes times;
  int attempts = 0, valid = 0;
};

double quantile(std::vector<double> v, double p) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(p * static_cast<double>(v.size() - 1))];
}

std::vector<std::unique_ptr<Place>>& places() {
  static std::vector<std::unique_ptr<Place>> list;
  return list;
}

void survey(int scenes, int attempts) {
  Sums sums;
  HashStream hash;
  std::map<std::pair<int, std::size_t>, std::map<int, std::pair<int, int>>> reached;
  std::map<double, std::pair<int, int>> by_heading;
  std::map<double, std::map<std::string, int>> heading_causes;
  int o_all = 0, o_ok = 0, groups = 0, groups_solved = 0;
  double setup_ms = 0;
  for (const char* folder : {"5", "10", "15"})
    for (int k = 0; k < scenes; ++k) {
      char name[128];
      const int base = std::string(folder) == "5" ? 100000 : std::string(folder) == "10" ? 200000 : 300000;
      std::snprintf(name, sizeof name, "%s/em4m_scenes/%s/plan_%06d_SCENE.txt", test::shared_data().c_str(), folder,
                    base + 2 * k);
      std::optional<Place> loaded = load(name);
      if (!loaded) continue;
      places().push_back(std::make_unique<Place>(std::move(*loaded)));
      Place& place = *places().back();
      const double t0 = thread_cpu_s();
      place.planner = std::make_unique<PushPlanner>(place.problem, place.kinematics, PushOptions{}, 1);
      setup_ms += 1e3 * (thread_cpu_s() - t0);
      add_requests(place, attempts);
      bool any = false;
      std::map<int, int> objects;
      for (std::size_t i = 0; i < place.requests.size(); ++i) {
        const PushRequest& request = place.requests[i];
        const double begin = thread_cpu_s();
        const PushOutcome out = place.planner->attempt(request, nullptr, nullptr);
        const double ms = 1e3 * (thread_cpu_s() - begin);
        sums.ms.push_back(ms);
        std::string cause(to_string(out.failure));
        if (out.violation && out.failure == PushFailure::violation)
          cause += " " + std::string(to_string(out.violation->kind));
        ++sums.causes[cause];
        ++sums.attempts;
        sums.valid += out.valid();
        objects[request.object.value] += out.valid();
        sums.times.start += out.times.start, sums.times.way += out.times.way, sums.times.approach += out.times.approach;
        sums.times.simulation += out.times.simulation, sums.times.retreat += out.times.retreat;
        const Eigen::Vector2d d = request.path[1] - request.path[0];
        auto& h = by_heading[std::round(100 * std::atan2(d.y(), d.x())) / 100];
        ++heading_causes[std::abs(std::round(100 * std::atan2(d.y(), d.x())) / 100)]
                        [std::string(to_string(out.failure))];
        ++h.second, h.first += out.valid();
        hash.add(static_cast<std::int32_t>(out.failure));
        for (const Eigen::VectorXd& q : out.push) hash.add(q[0]);
        if (request.attempt == 0) any = false, ++groups;
        if (out.valid() && !any) any = true, ++groups_solved;
      }
      for (auto [o, c] : objects) ++o_all, o_ok += c > 0;
    }
  std::printf("objects with a valid push: %d of %d\n", o_ok, o_all);
  std::printf("signature %s, %d attempts, %.1f %% valid; %d of %d paths valid within %d attempts\n",
              to_hex(hash.value()).c_str(), sums.attempts, 100.0 * sums.valid / std::max(1, sums.attempts),
              groups_solved, groups, attempts);
  for (const auto& [cause, count] : sums.causes)
    std::printf("  %-34s %5d %5.1f %%\n", cause.c_str(), count, 100.0 * count / sums.attempts);
  std::printf("  ms per attempt: 50%% %.2f  75%% %.2f  90%% %.2f  99%% %.2f; set-up %.1f ms\n", quantile(sums.ms, .5),
              quantile(sums.ms, .75), quantile(sums.ms, .9), quantile(sums.ms, .99),
              setup_ms / static_cast<double>(places().size()));
  const double n = sums.attempts;
  std::printf("  mean ms: start %.2f  way %.2f  approach %.2f  simulation %.2f  retreat %.2f\n",
              1e3 * sums.times.start / n, 1e3 * sums.times.way / n, 1e3 * sums.times.approach / n,
              1e3 * sums.times.simulation / n, 1e3 * sums.times.retreat / n);
  for (const auto& [heading, causes] : heading_causes) {
    std::printf("  |heading| %4.2f:", heading);
    int all = 0;
    for (const auto& [cause, count] : causes) all += count;
    for (const auto& [cause, count] : causes) std::printf(" %s %.0f", cause.c_str(), 100.0 * count / all);
    std::printf("\n");
  }
  for (const auto& [heading, c] : by_heading) std::printf("  heading %5.2f: %d of %d\n", heading, c.first, c.second);
}

/// Chains of pushes in every scene, replayed by the verifier.
void replay() {
  fixtures::Agreement agreement;
  for (std::size_t i = 0; i < places().size(); ++i)
    for (std::uint64_t k = 0; k < 3; ++k)
      if (const Place& p = *places()[i]; !p.requests.empty())
        agreement.add(p.problem, fixtures::random_chain(p.problem, p.kinematics, p.requests, 3, PushOptions{}, 10 * i + k));
  agreement.print();
  for (const std::string& text : agreement.violations) std::printf("  %s\n", text.c_str());
}

void attempt(benchmark::State& state) {
  std::size_t i = 0;
  if (places().empty()) return state.SkipWithError("no scenes (MAMO_SHARED_DATA)");
  for (auto _ : state) {
    Place& place = *places()[i++ % places().size()];
    if (place.requests.empty()) continue;
    benchmark::DoNotOptimize(place.planner->attempt(place.requests[i % place.requests.size()], nullptr, nullptr));
  }
}
BENCHMARK(attempt)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  survey(argc > 1 ? std::atoi(argv[1]) : 3, 3);
  replay();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
