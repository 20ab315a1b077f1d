// The serial driver: evaluates what a serial order needs, one edge after the other, on the caller's thread.
#pragma once

#include <vector>

#include "mamo/search/commit_log.hpp"
#include "mamo/search/state_table.hpp"

namespace mamo::search {

/// Generates the successors of one state at a time.
template <Domain D>
class SerialHost {
 public:
  SerialHost(const D& domain, typename D::Context& context, StateTable<D>& table)
      : domain_(domain), context_(context), table_(table) {}
  std::optional<std::span<const LazyEdge>> successors(StateId state) {
    domain_.successors(context_, table_.state(state), edges_);
    return std::span<const LazyEdge>(edges_);
  }
  StateId known_child([[maybe_unused]] const Need& need) {
    if constexpr (PredictsChild<D>) {
      if (domain_.known_child(table_.state(need.parent), need.action, child_)) return table_.intern(child_);
    }
    return kNoState;
  }
  void dropped(const Need&) {}

 private:
  const D& domain_;
  typename D::Context& context_;
  StateTable<D>& table_;
  std::vector<LazyEdge> edges_;
  typename D::State child_{};
};

/// Runs Order (LazyOrder or EagerOrder) to its end. Exceptions of the domain pass through.
template <template <class, class> class Order, Domain D>
SearchResult<typename D::State> serial_search(const D& domain, typename D::Context& context,
                                              const SearchOptions& options) {
  StateTable<D> table(domain);
  Order<D, StateTable<D>> order(domain, table, options);
  SerialHost<D> host(domain, context, table);
  const auto stopped = [&] { return options.stop && options.stop->stopped(); };

  if (!stopped()) order.begin(table.intern(domain.start()), host);
  for (std::uint32_t step = 0; !order.ended(); ++step) {
    if (stopped()) {
      order.abort(EndReason::stopped);
      break;
    }
    const Need* need = order.next(host);
    if (!need) break;
    const auto evaluated = domain.evaluate(context, table.state(need->parent), need->action, nullptr);
    if (evaluated.cancelled) {
      order.abort(EndReason::stopped);
      break;
    }
    order.commit({evaluated, evaluated.valid ? table.intern(evaluated.child) : kNoState}, host);
    if (options.on_progress && step % 16 == 0) options.on_progress(order.progress());
  }
  return order.result();
}

}  // namespace mamo::search
