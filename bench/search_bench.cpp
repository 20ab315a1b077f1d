// Parallel lazy weighted A* on the toy domain: against the serial search, predicted, and the cost of a commit.
//
// asleep: evaluations sleep for their scripted length, so that more workers than cores can be emulated; computing: they
// compute for about as long; predicted: the same scheduler in virtual time, on more problems. Counters of a row:
// speedup (sum of serial times / sum of times; problems of at least 3 s of serial work), efficiency (useful / all
// evaluation time), predicted_over_measured. Every order hash is compared with the serial one.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "mamo/common/hash.hpp"
#include "mamo/search/eager_order.hpp"
#include "mamo/search/lazy_order.hpp"
#include "mamo/search/parallel_search.hpp"
#include "mamo/search/toy_clutter.hpp"
#include "mamo/search/virtual_time.hpp"

namespace {

using namespace mamo::search;

constexpr double kWeight = 3;

ToyClutterOptions clutter(std::uint64_t seed, ToyDelay delay) {
  ToyClutterOptions o;
  o.seed = seed;
  o.side = 40;
  o.walls = 16;
  o.wall_radius = 9;
  o.movables = 25;
  o.movable_radius = 7;
  o.delay = delay;
  return o;
}

SearchOptions options() {
  SearchOptions o;
  o.weight = kWeight;
  return o;
}

double scripted_s(const ToyClutter& domain, const ToyState& s, std::int32_t action) {
  return 1e-3 * domain.evaluation_ms(s, action);
}

/// Seeds of solved problems with `lo` to `hi` seconds of serial work.
std::vector<std::uint64_t> problems(std::size_t count, double lo, double hi) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seeds.size() < count; ++seed) {
    const ToyClutter domain(clutter(seed, ToyDelay::none));
    SearchOptions o = options();
    o.max_evaluations = 100'000;
    ToyClutter::Context context;
    if (!serial_search<LazyOrder>(domain, context, o).found()) continue;
    const auto seconds = [&](const ToyState& s, std::int32_t a) { return scripted_s(domain, s, a); };
    const double work = work_and_span<LazyOrder>(domain, o, seconds).work_s;
    if (work >= lo && work <= hi) seeds.push_back(seed);
  }
  return seeds;
}

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "search_bench: %s\n", what);
  std::abort();
}

/// Problems whose evaluations sleep or compute, found once.
const std::vector<ToyClutter>& timed(ToyDelay delay) {
  static std::map<ToyDelay, std::vector<ToyClutter>> all;
  std::vector<ToyClutter>& problems_of = all[delay];
  if (problems_of.empty()) {
    for (const std::uint64_t seed : problems(3, 3, 8)) problems_of.emplace_back(clutter(seed, delay));
  }
  return problems_of;
}

/// Serial and parallel search of each problem in turn, so that what else the machine does meets both.
void measured(benchmark::State& state, ToyDelay delay, Schedule schedule, int threads) {
  double serial_s = 0, parallel_s = 0, predicted_s = 0;
  ParallelStats total;
  for (auto _ : state) {
    double this_run = 0;
    for (const ToyClutter& domain : timed(delay)) {
      ToyClutter::Context context;
      const double start = now_s();
      const auto serial = serial_search<LazyOrder>(domain, context, options());
      const double this_serial = now_s() - start;
      std::vector<ToyClutter::Context> contexts(static_cast<std::size_t>(threads));
      ParallelOptions parallel;
      parallel.schedule = schedule;
      parallel.measure = delay == ToyDelay::busy;
      ParallelStats stats;
      const double begun = now_s();
      const auto result = parallel_lazy_weighted_astar(domain, std::span(contexts), options(), parallel, &stats);
      this_run += now_s() - begun;
      demand(result.order_hash == serial.order_hash, "the parallel search is not the serial one");
      serial_s += this_serial;
      total.evaluation_s += stats.evaluation_s;
      total.used_s += stats.used_s;
      const auto seconds = [&](const ToyState& s, std::int32_t a) { return scripted_s(domain, s, a); };
      const ToyClutter quick(clutter(domain.options().seed, ToyDelay::none));
      const double work = work_and_span<LazyOrder>(quick, options(), seconds).work_s;
      // Scripted lengths scaled to what the serial run took.
      predicted_s +=
          virtual_search<LazyOrder>(quick, seconds, options(), parallel, threads).seconds * this_serial / work;
    }
    parallel_s += this_run;
    state.SetIterationTime(this_run);
  }
  state.counters["serial_s"] = serial_s / static_cast<double>(state.iterations());
  state.counters["speedup"] = serial_s / parallel_s;
  state.counters["predicted_over_measured"] = predicted_s / parallel_s;
  if (delay == ToyDelay::busy) state.counters["efficiency"] = total.efficiency();
}

void predicted(benchmark::State& state, Schedule schedule, int workers) {
  const std::vector<std::uint64_t> seeds = problems(20, 3, 1e9);
  for (auto _ : state) {
    double log_speedup = 0, work_s = 0, run_s = 0, busy_s = 0, clairvoyant = 0, span_s = 0, stall_s = 0, idle_s = 0;
    for (const std::uint64_t seed : seeds) {
      const ToyClutter domain(clutter(seed, ToyDelay::none));
      const auto seconds = [&](const ToyState& s, std::int32_t a) { return scripted_s(domain, s, a); };
      const WorkAndSpan work = work_and_span<LazyOrder>(domain, options(), seconds);
      ParallelOptions parallel;
      parallel.schedule = schedule;
      const VirtualRun run = virtual_search<LazyOrder>(domain, seconds, options(), parallel, workers);
      work_s += work.work_s;
      log_speedup += std::log(work.work_s / run.seconds);
      span_s += work.span_s;
      run_s += run.seconds;
      busy_s += run.busy_s;
      stall_s += run.stall_s;
      idle_s += run.idle_s;
      clairvoyant += clairvoyant_s(work, workers);
    }
    state.SetIterationTime(run_s);
    state.counters["speedup"] = work_s / run_s;
    state.counters["speedup_geomean"] = std::exp(log_speedup / static_cast<double>(seeds.size()));
    state.counters["of_clairvoyant"] = clairvoyant / run_s;
    state.counters["efficiency"] = work_s / busy_s;
    state.counters["work_over_span"] = work_s / span_s;
    state.counters["stall"] = stall_s / run_s;
    state.counters["idle"] = idle_s / (workers * run_s);
  }
}

/// Pop, evaluation of a toy edge (tens of nanoseconds), duplicate check, close, push of the successors.
void pop_and_commit(benchmark::State& state, bool engine) {
  const ToyClutter domain(clutter(1, ToyDelay::none));
  std::int64_t commits = 0;
  for (auto _ : state) {
    std::vector<ToyClutter::Context> one(1);
    ParallelOptions parallel;
    parallel.measure = engine;
    SearchOptions o = options();
    o.weight = 1;
    o.max_evaluations = 100'000;
    commits += parallel_lazy_weighted_astar(domain, std::span(one), o, parallel).counters.evaluations;
  }
  state.SetItemsProcessed(commits);
}

std::uint64_t signature() {
  std::uint64_t value = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ToyClutter domain(clutter(seed, ToyDelay::none));
    SearchOptions o = options();
    o.max_evaluations = 5'000;
    ToyClutter::Context context;
    const auto serial = serial_search<LazyOrder>(domain, context, o);
    value = mamo::hash_combine(value, serial.order_hash);
    for (const Schedule schedule : {Schedule::batch, Schedule::window, Schedule::runahead}) {
      std::vector<ToyClutter::Context> contexts(3);
      ParallelOptions parallel;
      parallel.schedule = schedule;
      const auto result = parallel_lazy_weighted_astar(domain, std::span(contexts), o, parallel);
      demand(result.order_hash == serial.order_hash, "the parallel search is not the serial one");
    }
  }
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("signature", mamo::to_hex(signature()));
  for (const bool engine : {false, true}) {
    const std::string name = engine ? "pop_and_commit/engine" : "pop_and_commit/serial";
    benchmark::RegisterBenchmark(name.c_str(), pop_and_commit, engine)->Unit(benchmark::kMillisecond);
  }
  for (const Schedule schedule : {Schedule::batch, Schedule::window, Schedule::runahead}) {
    const std::string name(to_string(schedule));
    for (const int workers : {1, 2, 4, 8, 16, 32, 64, 128}) {
      benchmark::RegisterBenchmark(("predicted/" + name + "/" + std::to_string(workers)).c_str(), predicted, schedule,
                                   workers)
          ->UseManualTime()
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
    const auto add_measured = [&](const char* how, ToyDelay delay, int threads) {
      const std::string row = std::string(how) + "/" + name + "/" + std::to_string(threads);
      benchmark::RegisterBenchmark(row.c_str(), measured, delay, schedule, threads)
          ->UseManualTime()
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    };
    add_measured("computing", ToyDelay::busy, 2);
    for (const int threads : {2, 4, 8, 16, 32}) add_measured("asleep", ToyDelay::sleep, threads);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
