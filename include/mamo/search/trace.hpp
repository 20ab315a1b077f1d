// A record of a parallel search: every job, when it was needed, what it cost. Input of the scaling prediction.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/search/commit_log.hpp"

namespace mamo::search {

/// One evaluation. Times are seconds since the search began; -1: never. States are ids of this run.
struct TraceJob {
  std::int32_t state = -1, edge = 0, worker = 0;
  bool head = false;            // the order was waiting for it when it was taken
  double taken = 0, done = -1;  // never done: given back
  double needed = -1;           // when it became what the order asks for
  double committed = -1;
  std::int64_t commit = -1;     // index among the commits; -1: not used
  double cpu_s = 0;             // thread CPU time of the evaluation, all tiers
  double costly_s = 0;          // of it: EdgeReport::costly_us, the dear tier (the lattice: physics)
  bool valid = false, cancelled = false;
  std::int32_t charge = 0;
  std::int32_t child = -1;
};

/// A state that was met; without edges unless its successors were generated.
struct TraceState {
  std::int32_t id = -1;
  std::int32_t class_of = -1;   // two states with the same value are in one class
  bool goal = false;
  Cost heuristic = 0;
  struct Edge {
    Cost cost = 0, heuristic = 0;
    std::int32_t known = -1;    // the only child it can have, or -1
  };
  std::vector<Edge> edges;
};

/// Filled by a scheduler under its lock; the states by the driver at the end.
struct Trace {
  double weight = 1;
  bool lazy = true;
  int threads = 1;
  std::string schedule;
  double wall_s = 0;
  std::int32_t start = -1;
  std::vector<TraceJob> jobs;
  std::vector<TraceState> states;

  std::int32_t begin_job(const Need& need, int worker, bool head, double now);
  void end_job(std::int32_t job, const Outcome& outcome, double cpu_s, double now);
  void need(const Need& need, std::int32_t job, double now);
  void commit_job(std::int32_t job, double now);

 private:
  std::int64_t commits_ = 0;
  Need awaited_;           // needed, not begun
  double awaited_at_ = -1;
};

/// Text: a header line, then one line per state ("S ...") and per job ("J ..."). Fields in the order of the structs.
void write_trace(const Trace& trace, std::ostream& out);
Result<Trace> read_trace(std::istream& in, const std::string& name);

}  // namespace mamo::search
