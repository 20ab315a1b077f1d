// OPEN and FOCAL of a bounded-suboptimal search: the best by a second criterion among those of small enough f.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mamo/search/domain.hpp"
#include "mamo/search/open_list.hpp"

namespace mamo::search {

/// Entries are numbered by the caller, 0, 1, 2, ... in the order of push. pop() gives the smallest (key, number) among
/// those whose cost <= w * lower_bound(), where lower_bound() is the largest value so far of the smallest f in the
/// queue: if f is admissible, no solution costs less. 0 <= f; the entry of the smallest f must have cost <= w * f, as
/// it has where cost is f itself. Key: ordered by <.
template <class Key>
class FocalQueue {
 public:
  explicit FocalQueue(Weight weight) : weight_(weight) {}

  void push(Cost f, Cost cost, const Key& key) {
    const auto id = static_cast<std::int32_t>(entries_.size());
    entries_.push_back({f, key, true});
    ++live_;
    add(by_f_, {f, id}, f_after);
    if (in_focal(cost))
      add_focal(id);
    else
      add(waiting_, {cost, id}, f_after);
  }
  /// Forgets an entry that is still in the queue; false if it is not.
  bool remove(std::int32_t id) {
    bool& alive = entries_[static_cast<std::size_t>(id)].alive;
    live_ -= alive;
    return std::exchange(alive, false);
  }

  bool empty() const { return live_ == 0; }
  /// Not of an empty queue.
  std::int32_t pop() {
    while (!alive(by_f_.front().id)) take(by_f_, f_after);
    bound_ = std::max(bound_, by_f_.front().f);
    while (!waiting_.empty() && in_focal(waiting_.front().f)) add_focal(take(waiting_, f_after).id);
    for (;;) {
      const std::int32_t id = take_focal();
      if (remove(id)) return id;
    }
  }
  Cost lower_bound() const { return bound_; }

 private:
  struct Entry {
    Cost f;
    Key key;
    bool alive;
  };
  struct ByF {
    Cost f;
    std::int32_t id;
  };
  static bool f_after(const ByF& a, const ByF& b) { return a.f != b.f ? a.f > b.f : a.id > b.id; }

  bool alive(std::int32_t id) const { return entries_[static_cast<std::size_t>(id)].alive; }
  bool in_focal(Cost cost) const { return 1000 * cost <= weight_.f(0, bound_); }

  template <class After>
  static void add(std::vector<ByF>& heap, ByF entry, After after) {
    heap.push_back(entry);
    std::push_heap(heap.begin(), heap.end(), after);
  }
  template <class After>
  static ByF take(std::vector<ByF>& heap, After after) {
    std::pop_heap(heap.begin(), heap.end(), after);
    const ByF out = heap.back();
    heap.pop_back();
    return out;
  }
  auto key_after() const {
    return [this](std::int32_t a, std::int32_t b) {
      const Key& x = entries_[static_cast<std::size_t>(a)].key;
      const Key& y = entries_[static_cast<std::size_t>(b)].key;
      return y < x || (!(x < y) && b < a);
    };
  }
  void add_focal(std::int32_t id) {
    focal_.push_back(id);
    std::push_heap(focal_.begin(), focal_.end(), key_after());
  }
  std::int32_t take_focal() {
    std::pop_heap(focal_.begin(), focal_.end(), key_after());
    const std::int32_t id = focal_.back();
    focal_.pop_back();
    return id;
  }

  Weight weight_;
  Cost bound_ = 0;
  std::size_t live_ = 0;
  std::vector<Entry> entries_;
  std::vector<ByF> by_f_;     // a heap: all entries. Dead ones may remain, here and below
  std::vector<ByF> waiting_;  // a heap by cost: those beyond the bound
  std::vector<std::int32_t> focal_;
};

}  // namespace mamo::search
