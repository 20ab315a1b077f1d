// Predicts how one search would have gone with 1 to 128 workers.
//
//   scaling TRACE [--workers 1,2,4,...] [--locked-us X] [--json]
//   scaling --problem FILE [--weight W] [--max-expansions N] ...
//   scaling --toy SEED ...      records a toy search with 2 threads first
//
// Runs the real scheduler in virtual time over evaluations of known length (thread CPU time). Prints work and span
// first: their ratio is about the most that any number of workers can win while keeping the serial order. A trace knows
// nothing of edges that only more workers would have met (trace_domain.hpp says what stands for them); --problem, the
// first planning iteration of fullsim, evaluates them when a virtual worker asks. Not modelled: the generation of
// successors, contention for caches and memory.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "lattice_search.hpp"
#include "memo_domain.hpp"

#include "mamo/search/eager_order.hpp"
#include "mamo/search/lazy_order.hpp"
#include "mamo/search/parallel_search.hpp"
#include "mamo/search/toy_clutter.hpp"
#include "mamo/search/trace_domain.hpp"
#include "mamo/search/virtual_time.hpp"

namespace {

using namespace mamo::search;

constexpr char kUsage[] = "usage: scaling TRACE|--toy SEED|--problem FILE [--weight W] [--max-expansions N] [--workers 1,2,4,...] [--locked-us MICROSECONDS] [--json]\n";

struct Arguments {
  std::string trace, problem;
  double weight = 100;
  std::int64_t max_expansions = kNoLimit;
  std::vector<int> workers{1, 2, 4, 8, 16, 32, 64, 128};
  double locked_us = 1;
  long toy = -1;
  bool json = false;
};

/// Exits with 64 when the arguments are not understood.
Arguments parse(int argc, char** argv) {
  Arguments a;
  const auto wrong = [](const std::string& what) {
    std::fprintf(stderr, "scaling: %s\n%s", what.c_str(), kUsage);
    std::exit(64);
  };
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--json") {
      a.json = true;
    } else if (word == "--workers" && more) {
      a.workers.clear();
      std::istringstream list(argv[++i]);
      for (std::string item; std::getline(list, item, ',');) a.workers.push_back(std::atoi(item.c_str()));
      for (const int w : a.workers) {
        if (w < 1 || w > 4096) wrong("--workers takes numbers from 1 to 4096");
      }
    } else if (word == "--locked-us" && more) {
      a.locked_us = std::atof(argv[++i]);
    } else if (word == "--problem" && more) {
      a.problem = argv[++i];
    } else if (word == "--weight" && more) {
      a.weight = std::atof(argv[++i]);
    } else if (word == "--max-expansions" && more) {
      a.max_expansions = std::atol(argv[++i]);
    } else if (word == "--toy" && more) {
      a.toy = std::atol(argv[++i]);
    } else if (a.trace.empty() && word[0] != '-') {
      a.trace = word;
    } else {
      wrong("what is " + word + "?");
    }
  }
  if (!a.trace.empty() + (a.toy >= 0) + !a.problem.empty() != 1) wrong("one trace is needed, or --problem, or --toy");
  if (!(a.weight >= 1) || a.max_expansions < 1) wrong("--weight and --max-expansions take numbers of at least 1");
  return a;
}

struct Row {
  int workers;
  Schedule schedule;
  double seconds, clairvoyant, stall, idle_share, efficiency;
};

struct Recorded {
  int threads = 0;  // 0: nothing was
  std::string schedule;
  double wall_s = 0;
};

void print(double weight, const WorkAndSpan& work, const Recorded& recorded, const std::vector<Row>& rows,
           const Arguments& arguments) {
  const std::size_t evaluations = work.commits.size();
  if (arguments.json) {
    std::printf(
        "{\"input\": \"%s\", \"weight\": %g, \"committed\": %zu, \"work_s\": %.6f, \"span_s\": %.6f, "
        "\"recorded_threads\": %d, \"recorded_schedule\": \"%s\", \"recorded_wall_s\": %.6f, \"rows\": [",
        (arguments.trace + arguments.problem).c_str(), weight, evaluations, work.work_s, work.span_s, recorded.threads,
        recorded.schedule.c_str(), recorded.wall_s);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& r = rows[i];
      std::printf(
          "%s\n {\"workers\": %d, \"schedule\": \"%s\", \"seconds\": %.6f, \"speedup\": %.4f, "
          "\"clairvoyant_s\": %.6f, \"stall_s\": %.6f, \"idle_share\": %.4f, \"efficiency\": %.4f}",
          i ? "," : "", r.workers, std::string(to_string(r.schedule)).c_str(), r.seconds, work.work_s / r.seconds,
          r.clairvoyant, r.stall, r.idle_share, r.efficiency);
    }
    std::printf("\n]}\n");
    return;
  }
  std::printf("weight %g, %zu committed evaluations, work %.3f s, span %.3f s, work / span %.1f\n", weight, evaluations,
              work.work_s, work.span_s, work.span_s > 0 ? work.work_s / work.span_s : 1.0);
  if (recorded.threads > 0) {
    std::printf("recorded with %d threads, %s: %.3f s\n", recorded.threads, recorded.schedule.c_str(),
                recorded.wall_s);
  }
  std::printf("%8s %-9s %10s %8s %12s %8s %8s %6s %10s\n", "workers", "schedule", "seconds", "speedup", "clairvoyant",
              "share", "stall_s", "idle", "efficiency");
  for (const Row& r : rows) {
    std::printf("%8d %-9s %10.3f %8.2f %12.3f %8.2f %8.3f %6.2f %10.2f\n", r.workers,
                std::string(to_string(r.schedule)).c_str(), r.seconds, work.work_s / r.seconds, r.clairvoyant,
                r.clairvoyant / r.seconds, r.stall, r.idle_share, r.efficiency);
  }
}

/// domain.seconds(state, action) says how long an evaluation takes.
template <template <class, class> class OrderT, Domain D>
void predict(const D& domain, const SearchOptions& options, const Recorded& recorded, const Arguments& arguments) {
  const auto seconds = [&](const typename D::State& s, std::int32_t action) { return domain.seconds(s, action); };
  const WorkAndSpan work = work_and_span<OrderT>(domain, options, seconds);
  VirtualCosts costs;
  costs.locked_s = 1e-6 * arguments.locked_us;
  std::vector<Row> rows;
  for (const int p : arguments.workers) {
    for (const Schedule schedule : {Schedule::batch, Schedule::window, Schedule::runahead}) {
      ParallelOptions parallel;
      parallel.schedule = schedule;
      const VirtualRun run = virtual_search<OrderT>(domain, seconds, options, parallel, p, costs);
      rows.push_back({p, schedule, run.seconds, clairvoyant_s(work, p), run.stall_s, run.idle_s / (p * run.seconds),
                      run.efficiency()});
    }
  }
  print(options.weight, work, recorded, rows, arguments);
}

/// The trace file, or the record of a toy search whose evaluations compute for 15 microseconds to 10 milliseconds.
mamo::Result<Trace> input(const Arguments& arguments) {
  if (arguments.toy < 0) {
    std::ifstream file(arguments.trace);
    if (!file) return mamo::Error{arguments.trace + ": cannot be read"};
    return read_trace(file, arguments.trace);
  }
  ToyClutterOptions toy;
  toy.seed = static_cast<std::uint64_t>(arguments.toy);
  toy.delay = ToyDelay::busy;
  toy.scale = 0.05;
  toy.side = 40;
  toy.walls = 16;
  toy.wall_radius = 9;
  toy.movables = 25;
  toy.movable_radius = 7;
  std::vector<ToyClutter::Context> contexts(2);
  Trace trace;
  ParallelOptions parallel;
  parallel.trace = &trace;
  SearchOptions options;
  options.weight = 3;
  options.max_evaluations = 5'000;
  parallel_lazy_weighted_astar(ToyClutter(toy), std::span(contexts), options, parallel);
  return trace;
}

int of_trace(const Arguments& arguments) {
  const auto trace = input(arguments);
  if (!trace.ok()) {
    std::fprintf(stderr, "%s\n", trace.error().message.c_str());
    return 3;
  }
  const TraceDomain domain(*trace);
  SearchOptions options;
  options.weight = trace->weight;
  options.max_evaluations = domain.commits();
  const Recorded recorded{trace->threads, trace->schedule, trace->wall_s};
  if (trace->lazy) {
    predict<LazyOrder>(domain, options, recorded, arguments);
  } else {
    predict<EagerOrder>(domain, options, recorded, arguments);
  }
  return 0;
}

int of_problem(const Arguments& arguments) {
  const auto search = mamo::LatticeSearch::load(arguments.problem);
  if (!search.ok()) {
    std::fprintf(stderr, "%s\n", search.error().message.c_str());
    return 3;
  }
  mamo::ManipulationLattice::Context context{&(*search)->evaluator(), {}};
  SearchOptions options;
  options.weight = arguments.weight;
  options.max_expansions = arguments.max_expansions;
  predict<LazyOrder>(MemoDomain((*search)->lattice(), context), options, {}, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  return arguments.problem.empty() ? of_trace(arguments) : of_problem(arguments);
}
