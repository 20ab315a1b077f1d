// Attempts at pushes on the published shelf scenes: what becomes of them, by cause, and what each stage costs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>

#include "support/push_chain.hpp"
#include "support/shared_data.hpp"

#include "mamo/common/cpu_time.hpp"
#include "mamo/common/hash.hpp"
#include "mamo/io/load.hpp"
#include "mamo/push/push_planner.hpp"

namespace {

using namespace mamo;

constexpr int kAttempts = 3;  // at each path

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

/// Backwards, sideways and obliquely forwards, 5 to 20 cm, where nothing that stays is in the way.
void add_requests(Place& place, int attempts) {
  const Problem& problem = place.problem;
  const WorldState start = WorldState::start_of(problem.scene);
  for (const ObjectId id : ObjectSet::of_kind(problem.scene, ObjectKind::movable).ids()) {
    if (std::get<Retrieve>(problem.task).object == id) continue;
    const Eigen::Vector2d p = problem.scene[id].X_WO.translation().head<2>();
    if (p.x() > 0.85) continue;                                              // near the front or in the middle
    for (const double heading : {0.0, 0.5, -0.5, 1.57, -1.57, 2.2, -2.2}) {  // rad; pi would be towards the robot
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

double quantile(std::vector<double> v, double p) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(p * static_cast<double>(v.size() - 1))];
}

std::vector<std::unique_ptr<Place>>& places() {
  static std::vector<std::unique_ptr<Place>> list;
  return list;
}

/// The first `scenes` scenes with 5, 10 and 15 extra movable objects.
void load_places(int scenes) {
  for (const auto& [folder, first] : {std::pair("5", 100000), std::pair("10", 200000), std::pair("15", 300000)})
    for (int k = 0; k < scenes; ++k) {
      char name[64];
      std::snprintf(name, sizeof name, "em4m_scenes/%s/plan_%06d_SCENE.txt", folder, first + 2 * k);
      std::optional<Place> loaded = load(test::shared_data() + "/" + name);
      if (!loaded) continue;
      places().push_back(std::make_unique<Place>(std::move(*loaded)));
      Place& place = *places().back();
      place.planner = std::make_unique<PushPlanner>(place.problem, place.kinematics, PushOptions{}, 1);
      add_requests(place, kAttempts);
    }
}

struct Count {
  int valid = 0, all = 0;
  void add(bool is_valid) { valid += is_valid, ++all; }
};

struct Survey {
  std::map<std::string, int> causes;
  std::map<int, Count> by_heading;  // degrees, to both sides
  std::vector<Count> objects, paths;
  std::vector<double> ms, share;
  PushTimes times;
  HashStream hash;

  void add(const PushRequest& request, const PushOutcome& out, double attempt_ms) {
    std::string cause(to_string(out.failure));
    if (out.violation) cause += " " + std::string(to_string(out.violation->kind));
    ++causes[cause];
    ms.push_back(attempt_ms);
    if (out.valid()) share.push_back(out.share);
    const Eigen::Vector2d d = request.path[1] - request.path[0];
    by_heading[static_cast<int>(std::lround(std::abs(std::atan2(d.y(), d.x())) * 180 / std::numbers::pi))].add(
        out.valid());
    objects.back().add(out.valid());
    paths.back().add(out.valid());
    times.start += out.times.start, times.way += out.times.way, times.approach += out.times.approach;
    times.simulation += out.times.simulation, times.retreat += out.times.retreat;
    hash.add(static_cast<std::int32_t>(out.failure));
    for (const Eigen::VectorXd& q : out.push) hash.add(q[0]);
  }

  static void print(const char* what, const std::vector<Count>& counts) {
    int any = 0, valid = 0, all = 0;
    for (const Count& c : counts)
      if (c.valid > 0) ++any, valid += c.valid, all += c.all;
    std::printf("  %d of %zu %s can be pushed; of the attempts on those %.0f %% are valid\n", any, counts.size(), what,
                100.0 * valid / std::max(1, all));
  }
  void print() const {
    const double n = static_cast<double>(ms.size());
    std::printf("signature %s, %zu attempts, %.1f %% valid\n", to_hex(hash.value()).c_str(), ms.size(),
                100.0 * static_cast<double>(share.size()) / n);
    print("objects", objects);
    print("paths", paths);
    std::printf("  share of the path: 10%% %.2f  25%% %.2f  50%% %.2f\n", quantile(share, 0.1), quantile(share, 0.25),
                quantile(share, 0.5));
    for (const auto& [cause, count] : causes)
      std::printf("  %-34s %5d %5.1f %%\n", cause.c_str(), count, 100 * count / n);
    for (const auto& [heading, c] : by_heading)
      std::printf("  heading %3d degrees: %d of %d\n", heading, c.valid, c.all);
    std::printf("  ms per attempt: 50%% %.2f  75%% %.2f  90%% %.2f  99%% %.2f\n", quantile(ms, 0.5), quantile(ms, 0.75),
                quantile(ms, 0.9), quantile(ms, 0.99));
    std::printf("  mean ms: start %.2f  way %.2f  approach %.2f  simulation %.2f  retreat %.2f\n",
                1e3 * times.start / n, 1e3 * times.way / n, 1e3 * times.approach / n, 1e3 * times.simulation / n,
                1e3 * times.retreat / n);
  }
};

void survey() {
  Survey survey;
  for (const auto& place : places())
    for (const PushRequest& request : place->requests) {
      if (request.attempt == 0) {
        survey.paths.emplace_back();
        if (&request == place->requests.data() || request.object != (&request - 1)->object)
          survey.objects.emplace_back();
      }
      const double begin = thread_cpu_s();
      const PushOutcome out = place->planner->attempt(request, nullptr, nullptr);
      survey.add(request, out, 1e3 * (thread_cpu_s() - begin));
    }
  if (!survey.ms.empty()) survey.print();
}

/// Chains of pushes in every scene, replayed by the verifier.
void replay() {
  fixtures::Agreement agreement;
  for (std::size_t i = 0; i < places().size(); ++i)
    for (std::uint64_t k = 0; k < 3; ++k)
      if (const Place& p = *places()[i]; !p.requests.empty())
        agreement.add(p.problem,
                      fixtures::random_chain(p.problem, p.kinematics, p.requests, 3, PushOptions{}, 10 * i + k));
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
  load_places(argc > 1 ? std::atoi(argv[1]) : 3);
  survey();
  replay();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
