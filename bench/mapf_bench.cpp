// Path finding among movable objects: one call per shelf, times by number of movables, and what the calls found.
//
// Shelves built in code, and those of $MAMO_SHARED_DATA/em4m_scenes (else ../shared/data) if they are there. The region
// is the way out of the target, as a box. Answers are checked by replaying the joint solution before anything is timed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "support/replay_paths.hpp"
#include "support/shared_data.hpp"
#include "support/shelf_cases.hpp"

#include "mamo/common/hash.hpp"
#include "mamo/io/load.hpp"
#include "mamo/mapf/object_paths.hpp"

namespace {

using namespace mamo;

struct Group {
  std::string name;
  std::vector<test::ShelfCase> cases;
};

Group built(int movables) {
  Group out{"built " + std::to_string(movables), {}};
  for (std::uint64_t seed = 0; seed < 60; ++seed) out.cases.push_back(test::shelf_case(movables, 4, seed));
  return out;
}

Group published(const std::string& folder) {
  Group out{"em4m " + folder, {}};
  const std::filesystem::path path = test::shared_data() + "/em4m_scenes/" + folder;
  if (!std::filesystem::exists(path)) return out;
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) files.insert(entry.path().string());
  for (const std::string& file : files) {
    Result<Problem> problem = io::load_problem(file);
    if (!problem) continue;
    const auto* task = std::get_if<Retrieve>(&problem->task);
    if (!task) continue;
    const Eigen::Matrix3d R = task->X_WT_pregrasp.linear();
    test::ShelfCase c{
        std::filesystem::path(file).stem(), *problem, task->object, WorldState::start_of(problem->scene), {}};
    c.region = test::way_out(c.problem.scene, c.target, std::atan2(R(1, 0), R(0, 0)));
    out.cases.push_back(std::move(c));
  }
  return out;
}

/// A vertex's life: call, ban the goals found (each as if all its pushes had failed), call again.
struct Calls {
  std::vector<ObjectPathsResult> results;
  std::vector<double> ms;
};
Calls calls_of(const test::ShelfCase& c, const ObjectPathFinder& finder, int rounds) {
  Calls out;
  std::map<ObjectId, InvalidGoals> invalid;
  for (int k = 0; k < rounds; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    out.results.push_back(finder.solve(c.state, c.region, invalid, nullptr));
    out.ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    if (!out.results.back().solved || out.results.back().paths.empty()) break;
    for (const ObjectPath& path : out.results.back().paths) invalid[path.object][path.goal] = 5;
  }
  return out;
}

double part(std::vector<double> v, double share) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(share * static_cast<double>(v.size())))];
}

bool report(const Group& group) {
  if (group.cases.empty()) {
    std::printf("%-10s not there\n", group.name.c_str());
    return true;
  }
  HashStream hash;
  std::vector<double> first, later, nodes, expansions;
  int calls = 0, solved = 0, budget = 0, stuck = 0, idle = 0, paths = 0;
  for (const test::ShelfCase& c : group.cases) {
    const ObjectPathFinder finder(c.problem, c.target, {});
    const Calls all = calls_of(c, finder, 8);
    for (std::size_t k = 0; k < all.results.size(); ++k) {
      const ObjectPathsResult& r = all.results[k];
      ++calls, solved += r.solved, budget += r.budget_used_up, stuck += !r.stuck.empty();
      idle += r.solved && r.paths.empty();
      paths += static_cast<int>(r.paths.size());
      if (!(r.solved && r.paths.empty())) (k == 0 ? first : later).push_back(all.ms[k]);
      nodes.push_back(static_cast<double>(r.high_level_nodes));
      expansions.push_back(static_cast<double>(r.low_level_expansions));
      const std::string wrong = r.solved ? test::replay_error(c.problem, c.target, c.state, c.region, r) : "";
      if (!wrong.empty()) {
        std::fprintf(stderr, "%s, %s: %s\n", group.name.c_str(), c.name.c_str(), wrong.c_str());
        return false;
      }
      hash.add(r.cost);
      for (const ObjectPath& p : r.paths)
        for (const GridCell& cell : p.cells) hash.add(cell.x), hash.add(cell.y);
    }
  }
  std::printf("%-10s calls %4d: solved %4d (nobody moves %d), stuck %d, budget %d; paths %.2f\n", group.name.c_str(),
              calls, solved, idle, stuck, budget, static_cast<double>(paths) / std::max(1, solved - idle));
  const auto row = [](const char* what, const std::vector<double>& v, const char* unit) {
    std::printf("  %-12s 50%% %8.2f  75%% %8.2f  95%% %8.2f  100%% %8.2f %s\n", what, part(v, 0.5), part(v, 0.75),
                part(v, 0.95), part(v, 1), unit);
  };
  row("first call", first, "ms");
  row("later calls", later, "ms");
  row("nodes", nodes, "");
  row("expansions", expansions, "");
  std::printf("  signature %s\n", to_hex(hash.value()).c_str());
  return true;
}

void call(benchmark::State& state, const std::vector<test::ShelfCase>& cases) {
  std::vector<std::unique_ptr<ObjectPathFinder>> finders;
  for (const test::ShelfCase& c : cases)
    finders.push_back(std::make_unique<ObjectPathFinder>(c.problem, c.target, ObjectPathsOptions{}));
  std::size_t k = 0;
  for (auto _ : state) {
    const test::ShelfCase& c = cases[k % cases.size()];
    benchmark::DoNotOptimize(finders[k++ % cases.size()]->solve(c.state, c.region, {}, nullptr).cost);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<Group> groups;
  for (const int movables : {5, 10, 15}) groups.push_back(built(movables));
  for (const char* folder : {"5", "10", "15"}) groups.push_back(published(folder));
  for (const Group& group : groups)
    if (!report(group)) return 1;
  for (const Group& group : groups)
    if (!group.cases.empty())
      benchmark::RegisterBenchmark(("call/" + group.name).c_str(), call, group.cases)->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
}
