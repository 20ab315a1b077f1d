// How a parallel search schedules, and what it says of itself. None of it changes a result.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace mamo {
class Executor;
}

namespace mamo::search {

struct Trace;

/// What workers may evaluate before its turn:
///   batch     the K best entries of OPEN, then everybody waits until the order asks for another edge;
///   window    the best of OPEN, at any time;
///   runahead  also the edges of states that are evaluated but not committed.
enum class Schedule { batch, window, runahead };
std::string_view to_string(Schedule schedule);
std::optional<Schedule> schedule_from(std::string_view name);

struct ParallelOptions {
  Schedule schedule = Schedule::runahead;
  /// K, 0: the schedule's default. batch: entries of OPEN in one batch (16 per worker, eager 1); window: depth of OPEN
  /// looked at (all of it); runahead: outcomes ahead of a piece of work that may be waiting for their turn (any
  /// number).
  int batch = 0;
  Executor* executor = nullptr;  // null: the search makes its own; must have as many workers as there are contexts
  bool measure = false;          // fills the times of ParallelStats
  Trace* trace = nullptr;        // filled if not null
};

/// Differs from run to run. Times are thread CPU time (s), summed over workers.
struct ParallelStats {
  std::int64_t evaluations = 0;                               // begun, whatever became of them
  std::int64_t cancelled = 0;                                 // stopped on the way
  std::int64_t used = 0;                                      // committed
  std::int64_t charge = 0;                                    // EdgeReport::charge of all that were evaluated
  std::int64_t heads = 0, heads_done = 0, heads_running = 0;  // how the order's needs were found when first asked for
  double evaluation_s = 0, used_s = 0;
  double efficiency() const { return evaluation_s > 0 ? used_s / evaluation_s : 1.0; }
};

}  // namespace mamo::search
