// Weighted A*, serial: evaluates all outgoing edges of every state it expands.
#pragma once

#include "mamo/search/eager_order.hpp"
#include "mamo/search/serial_search.hpp"

namespace mamo::search {

/// Finds a path of cost <= W x optimum from domain.start() to a goal. The algorithm and its claims: EagerOrder.
template <Domain D>
SearchResult<typename D::State> weighted_astar(const D& domain, typename D::Context& context,
                                               const SearchOptions& options) {
  return serial_search<EagerOrder>(domain, context, options);
}

}  // namespace mamo::search
