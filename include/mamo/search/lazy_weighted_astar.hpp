// Lazy weighted A*, serial: the reference for everything parallel.
#pragma once

#include "mamo/search/lazy_order.hpp"
#include "mamo/search/serial_search.hpp"

namespace mamo::search {

/// Finds a path of cost <= W x optimum from domain.start() to a goal, evaluating edges only when their turn in OPEN
/// has come. The algorithm and its claims: LazyOrder.
template <Domain D>
SearchResult<typename D::State> lazy_weighted_astar(const D& domain, typename D::Context& context,
                                                    const SearchOptions& options) {
  return serial_search<LazyOrder>(domain, context, options);
}

}  // namespace mamo::search
