// The part of the state space that is known but not committed: who leads where, how urgent it is, what to do next.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "mamo/search/bench_key.hpp"
#include "mamo/search/expansion.hpp"

namespace mamo::search {

/// The states that workers have met ("shadows": evaluated, most of them not committed yet), linked by the edges that
/// are done, and PENDING, the queue of what could be evaluated ahead. Only speed depends on anything in here.
///
/// The bench key. A shadow's edge may have a tiny f, but the serial order cannot pop it before it has popped the
/// edges that lead there. So edges are ordered by Bench, then f, then larger g. Ordering by raw f instead wastes most
/// speculation; ordering by the largest f alone wastes it where many workers run far ahead.
/// A state that several edges lead to has the least (bench, g) among them, and remembers whose: when that one dies, the
/// state and what hangs on it are weighed anew. Without that, regions that many paths lead into keep the urgency of
/// paths that are no more, and with dozens of workers nearly all speculation goes there.
///
/// A shadow is alive while it is closed, or its class is open and a done edge of a living state leads to it. Only
/// living shadows have entries in PENDING; each has one: its best fresh edge. Entries are replaced by version.
///
/// Not synchronised: the scheduler's lock guards it.
template <Domain D, bool lazy>
class ShadowGraph {
 public:
  struct Shadow {
    std::unique_ptr<Expansion> expansion;
    Bench bench = Bench::never();
    Cost g = kUnreachable, h = 0;
    std::vector<std::pair<StateId, std::int32_t>> in;  // done edges that led here, with their states
    StateId from = kNoState;                            // the one of them that gave bench and g
    std::int32_t live_in = 0;                           // those of living states
    std::uint32_t version = 0;  // of its entry in PENDING
    std::int32_t cursor = 0;    // into expansion->order: everything before is not fresh
    std::int32_t round = -1;    // of schedule `batch`
    StateId next_in_class = kNoState, first_in_class = kNoState;
    bool met = false, alive = false, closed = false, opened = false;
    bool generating = false, failed = false;  // its successors are being generated; that threw
  };
  struct Item {
    BenchKey key;
    std::int32_t state;
    std::uint32_t version;
    friend bool operator<(const Item& a, const Item& b) {  // max-heap: the best last
      if (b.key < a.key) return true;
      if (a.key < b.key) return false;
      return a.state > b.state;
    }
  };

  /// ahead: shadows may be pending before they are committed (schedule runahead).
  ShadowGraph(const StateTable<D>& table, const Weight& weight, bool ahead)
      : table_(table), weight_(weight), ahead_(ahead) {}

  Shadow& at(StateId id) {
    if (shadows_.size() <= id.index()) shadows_.resize(std::max(table_.id_bound(), id.index() + 1));
    return shadows_[id.index()];
  }
  const Shadow* peek(StateId id) const { return id.index() < shadows_.size() ? &shadows_[id.index()] : nullptr; }

  /// Keeps the successors of a state, unless it has some.
  void adopt(StateId id, std::unique_ptr<Expansion> expansion) {
    Shadow& s = at(id);
    if (s.expansion || !expansion) return;
    s.expansion = std::move(expansion);
    requeue(id);
  }

  /// A done edge of `parent` leads to `child`.
  void link(StateId parent, std::int32_t edge, StateId child) {
    meet(child);
    at(child).in.emplace_back(parent, edge);
    const Shadow& p = at(parent);
    if (!p.alive) return;
    if (p.g != kUnreachable) improve(step_over(parent, edge, child));
    ++at(child).live_in;
    set_alive(child);
  }

  /// The order has closed a state: its edges' turn is by their own f, other members of its class are dead.
  void close(StateId id, Cost g) {
    meet(id);
    Shadow& s = at(id);
    s.closed = true;
    s.bench = Bench::now();
    s.g = g;
    for (StateId m = at(table_.class_of(id)).first_in_class; m != kNoState; m = at(m).next_in_class) set_alive(m);
    relax_children(id);
    run_steps();
    requeue(id);
  }
  /// The (eager) order has put a state into OPEN.
  void open(StateId id, Cost g) {
    meet(id);
    improve({id, kNoState, Bench::now(), g, at(id).h});
    at(id).opened = true;
    set_alive(id);
    requeue(id);
  }

  /// An edge is fresh again.
  void rewind(StateId id) {
    at(id).cursor = 0;
    requeue(id);
  }

  BenchKey key_of(const Shadow& s, std::int32_t edge) const {
    if constexpr (lazy) {
      const LazyEdge& e = s.expansion->edges[static_cast<std::size_t>(edge)];
      const Cost g = s.g + e.cost, f = weight_.f(g, e.heuristic);
      return {s.bench.after(f), f, g};
    } else {
      if (s.closed) return {Bench::now(), Bench::kNow, s.g};
      const Cost f = weight_.f(s.g, s.h);
      return {s.bench.after(f), f, s.g};
    }
  }

  /// The best entry of PENDING: {state, edge}, edge kSuccessors where they must be generated first. Nothing is taken.
  std::optional<std::pair<StateId, std::int32_t>> best() {
    while (!pending_.empty()) {
      const Item top = pending_.front();
      Shadow& s = shadows_[static_cast<std::size_t>(top.state)];
      if (top.version != s.version) {
        drop_top();
        continue;
      }
      if (!s.expansion) return std::pair(StateId(top.state), Need::kSuccessors);
      const std::int32_t edge = s.expansion->order[static_cast<std::size_t>(s.cursor)];
      if (s.expansion->cells[static_cast<std::size_t>(edge)].phase == CellPhase::fresh) {
        return std::pair(StateId(top.state), edge);
      }
      advance_top(s, top.state);
    }
    return std::nullopt;
  }
  /// Passes over best(): it was taken, or is not worth taking.
  void pass() {
    const Item top = pending_.front();
    advance_top(shadows_[static_cast<std::size_t>(top.state)], top.state);
  }

  bool changed() { return std::exchange(changed_, false); }  // entries were added since the last call
  std::size_t pending_size() const { return pending_.size(); }
  /// Called with each state that dies: nothing that it leads to can be needed.
  std::function<void(StateId)> on_death;

 private:
  bool eligible(const Shadow& s) const {
    if (!s.alive || s.failed || s.g == kUnreachable) return false;
    return ahead_ || s.closed || s.opened;
  }

  void meet(StateId id) {
    Shadow& s = at(id);
    if (s.met) return;
    s.met = true;
    Shadow& representative = at(table_.class_of(id));
    s.next_in_class = representative.first_in_class;
    representative.first_in_class = id;
  }

  void push(const Item& item) {
    pending_.push_back(item);
    std::push_heap(pending_.begin(), pending_.end());
    changed_ = true;
  }
  void drop_top() {
    std::pop_heap(pending_.begin(), pending_.end());
    pending_.pop_back();
  }
  /// Replaces the top entry, which is s's, by the one of its next edge.
  void advance_top(Shadow& s, std::int32_t id) {
    drop_top();
    ++s.version;
    if (!s.expansion) return;
    ++s.cursor;
    enqueue(s, id);
  }
  /// Gives the state the entry it should have, or none.
  void requeue(StateId id) {
    Shadow& s = at(id);
    ++s.version;
    if (pending_.size() > 4096 + 4 * shadows_.size()) compact();
    enqueue(s, id.value);
  }
  void enqueue(Shadow& s, std::int32_t id) {
    if (!eligible(s)) return;
    if (!s.expansion) {
      if (!lazy && !s.generating) push({key_of(s, 0), id, s.version});
      return;
    }
    const Expansion& x = *s.expansion;
    const auto end = static_cast<std::int32_t>(x.order.size());
    const auto edge = [&] { return static_cast<std::size_t>(x.order[static_cast<std::size_t>(s.cursor)]); };
    while (s.cursor < end && x.cells[edge()].phase != CellPhase::fresh) ++s.cursor;
    if (s.cursor < end) push({key_of(s, static_cast<std::int32_t>(edge())), id, s.version});
  }
  void compact() {
    std::erase_if(pending_,
                  [&](const Item& i) { return i.version != shadows_[static_cast<std::size_t>(i.state)].version; });
    std::make_heap(pending_.begin(), pending_.end());
  }

  struct Step {
    StateId id, from;
    Bench bench;
    Cost g, h;
  };
  /// What `parent` and its edge say of the child's bench, g and h.
  Step step_over(StateId parent, std::int32_t edge, StateId child) {
    const Shadow& p = at(parent);
    const LazyEdge& e = p.expansion->edges[static_cast<std::size_t>(edge)];
    const Cost g = p.g + e.cost;
    if constexpr (lazy) return {child, parent, p.bench.after(weight_.f(g, e.heuristic)), g, e.heuristic};
    return {child, parent, p.closed ? Bench::now() : key_of(p, edge).bench, g, e.heuristic};
  }

  /// Lowers (bench, g) of a state and of all that hang on it through done edges. Ends: a value that comes round a
  /// cycle has a larger g, and never a smaller bench.
  void improve(const Step& first) {
    steps_.push_back(first);
    run_steps();
  }
  void run_steps() {
    while (!steps_.empty()) {
      const Step step = steps_.back();
      steps_.pop_back();
      Shadow& s = at(step.id);
      if (std::tie(step.bench, step.g) >= std::tie(s.bench, s.g)) continue;
      s.bench = step.bench;
      s.g = step.g;
      s.h = step.h;
      s.from = step.from;
      relax_children(step.id);
      requeue(step.id);
    }
  }
  void relax_children(StateId id) {
    if (!at(id).alive || at(id).g == kUnreachable) return;
    each_child(at(id), [&](std::int32_t edge, StateId child) { steps_.push_back(step_over(id, edge, child)); });
  }

  /// Settles whether a state lives, and then those that hang on it.
  void set_alive(StateId first) {
    const std::size_t bottom = settle_.size();
    settle_.push_back(first);
    while (settle_.size() > bottom) {
      const StateId id = settle_.back();
      settle_.pop_back();
      Shadow& s = at(id);
      const bool alive = s.closed || ((s.live_in > 0 || s.opened) && table_.closed_by(id) == kNoState);
      if (alive == s.alive) continue;
      s.alive = alive;
      if (alive) {
        relax_children(id);
      } else {
        orphans_.push_back(id);
      }
      each_child(s, [&](std::int32_t, StateId child) {
        at(child).live_in += alive ? 1 : -1;
        settle_.push_back(child);
      });
      if (!alive && on_death) on_death(id);
      requeue(id);
    }
    if (bottom > 0) return;
    run_steps();
    weigh_anew();
  }

  /// The dead, and all that had (bench, g) from them, forget these; the living among them get what others have to give.
  /// What only a circle of shadows keeps alive gets nothing.
  void weigh_anew() {
    for (std::size_t i = 0; i < orphans_.size(); ++i) {
      const StateId id = orphans_[i];
      Shadow& s = at(id);
      s.bench = Bench::never();
      s.g = kUnreachable;
      s.from = kNoState;
      each_child(s, [&](std::int32_t, StateId child) {
        Shadow& c = at(child);
        if (c.from != id || c.closed || c.opened) return;
        c.from = kNoState;
        orphans_.push_back(child);
      });
    }
    for (const StateId id : orphans_) {
      requeue(id);
      if (!at(id).alive) continue;
      for (const auto& [parent, edge] : at(id).in) {
        const Shadow& p = at(parent);
        if (!p.alive || p.g == kUnreachable) continue;
        if (p.expansion->cells[static_cast<std::size_t>(edge)].phase == CellPhase::done) {
          improve(step_over(parent, edge, id));
        }
      }
    }
    orphans_.clear();
  }
  /// Visits the children that done edges lead to.
  template <class Visit>
  void each_child(const Shadow& s, Visit visit) {
    if (!s.expansion) return;
    const std::vector<Cell>& cells = s.expansion->cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].phase == CellPhase::done && cells[i].valid) visit(static_cast<std::int32_t>(i), cells[i].child);
    }
  }

  const StateTable<D>& table_;
  const Weight& weight_;
  bool ahead_;
  bool changed_ = false;
  std::deque<Shadow> shadows_;   // by state id
  std::vector<Item> pending_;    // max-heap of Item's order: the most urgent on top
  std::vector<Step> steps_;      // to be taken; empty between calls
  std::vector<StateId> settle_, orphans_;  // likewise
};

}  // namespace mamo::search
