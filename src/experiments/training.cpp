#include "mamo/experiments/training.hpp"

#include <atomic>
#include <thread>

#include "mamo/em4m/em4m_planner.hpp"

namespace mamo {
namespace {

struct Rearrangement {
  WorldState state;
  RegionFeatures features;
};

PlanOptions options_of(const TrainingSpec& spec, std::int64_t expansions, std::int64_t simulations) {
  PlanOptions options;
  options.seed = spec.seed;
  options.max_expansions = expansions;
  options.max_simulations = simulations;
  options.smooth = false;
  options.set = spec.set;
  options.set["regions"] = "1";
  return options;
}

/// At most `most` of the items, evenly spaced, the first among them.
template <class T>
std::vector<T> spaced(std::vector<T> items, int most) {
  const std::size_t n = items.size(), m = static_cast<std::size_t>(most);
  if (n <= m) return items;
  std::vector<T> kept;
  for (std::size_t i = 0; i < m; ++i) kept.push_back(std::move(items[i * n / m]));
  return kept;
}

std::vector<Rearrangement> breadth_first(const Problem& problem, const TrainingSpec& spec, StopSource& stop) {
  std::vector<Rearrangement> found;
  Em4mVariant variant;
  variant.name = "em4m";
  variant.order = Em4mOrder::breadth_first;
  variant.retrieves = false;
  variant.on_vertex = [&](const WorldState& state, const RegionFeatures& features) {
    found.push_back({state, features});
  };
  make_em4m_planner(variant)->plan(problem, options_of(spec, spec.collect_expansions, spec.collect_simulations),
                                   {&stop, nullptr, {}});
  return spaced(std::move(found), spec.vertices);
}

bool depth_first_finds(const Problem& problem, const WorldState& state, const TrainingSpec& spec, StopSource& stop) {
  Problem from_here = problem;
  for (std::size_t i = 0; i < from_here.scene.size(); ++i)
    if (!from_here.scene.objects[i].fixture()) from_here.scene.objects[i].X_WO = state.X_WO(ObjectId(i));
  Em4mVariant variant;
  variant.name = "em4m";
  variant.order = Em4mOrder::depth_first;
  return make_em4m_planner(variant)
      ->plan(from_here, options_of(spec, spec.try_expansions, spec.try_simulations), {&stop, nullptr, {}})
      .found;
}

}  // namespace

ShelfSpec training_shelf(const TrainingSpec& spec, int k) {
  ShelfSpec shelf;
  shelf.movable = 5 * (k % 3 + 1);
  shelf.difficulty = static_cast<Difficulty>(1 + k / 3 % 3);
  shelf.seed = spec.seed;
  shelf.index = k / 9;
  return shelf;
}

Result<std::vector<TrainingPoint>> training_points(const TrainingSpec& spec, StopSource& stop,
                                                   const std::function<void(int, int)>& progress) {
  std::vector<TrainingPoint> points;
  for (int k = 0; k < spec.scenes && !stop.stopped(); ++k) {
    const Result<Problem> problem = generate_shelf(training_shelf(spec, k));
    if (!problem.ok()) return problem.error();
    const std::vector<Rearrangement> rearrangements = breadth_first(*problem, spec, stop);
    std::vector<TrainingPoint> of_scene(rearrangements.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; !stop.stopped() && (i = next++) < of_scene.size();)
        of_scene[i] = {rearrangements[i].features, depth_first_finds(*problem, rearrangements[i].state, spec, stop)};
    };
    {
      std::vector<std::jthread> others;
      for (int j = 1; j < spec.jobs; ++j) others.emplace_back(work);
      work();
    }
    if (stop.stopped()) break;  // the scene's points are not all there
    points.insert(points.end(), of_scene.begin(), of_scene.end());
    if (progress) progress(k + 1, static_cast<int>(points.size()));
  }
  return points;
}

}  // namespace mamo
