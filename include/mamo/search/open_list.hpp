// OPEN: a binary heap with a total order on integers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "mamo/search/domain.hpp"

namespace mamo::search {

/// The suboptimality factor, in thousandths, so that f is an integer. f is in thousandths of a cost.
class Weight {
 public:
  explicit Weight(double weight) {
    if (!(weight >= 1.0 && weight <= 1e6)) throw std::invalid_argument("search weight must be in [1, 1e6]");
    milli_ = std::llround(weight * 1000.0);
  }
  Cost f(Cost g, Cost h) const { return 1000 * g + milli_ * h; }
  double value() const { return static_cast<double>(milli_) / 1000.0; }

 private:
  Cost milli_ = 1000;
};

/// An entry of OPEN. `node` is the committed search node it hangs on; `edge` and `action` name the edge that
/// leads on from there (eager: that led here, to `state`).
struct OpenEntry {
  Cost f = 0, g = 0;
  std::int64_t seq = 0;  // given at commit: the serial order of pushes
  std::int32_t node = -1, edge = -1, action = 0, state = -1;

  /// Smaller f, then larger g, then earlier push: total, since seq is unique.
  bool before(const OpenEntry& other) const {
    if (f != other.f) return f < other.f;
    if (g != other.g) return g > other.g;
    return seq < other.seq;
  }
};

/// Min-heap of OpenEntry. A plain array, so that a scheduler may look at the best entries without popping them.
class OpenList {
 public:
  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  const OpenEntry& top() const { return heap_.front(); }
  void push(const OpenEntry& entry) {
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end(), after);
  }
  void pop() {
    std::pop_heap(heap_.begin(), heap_.end(), after);
    heap_.pop_back();
  }
  const std::vector<OpenEntry>& heap() const { return heap_; }

 private:
  static bool after(const OpenEntry& a, const OpenEntry& b) { return b.before(a); }
  std::vector<OpenEntry> heap_;
};

}  // namespace mamo::search
