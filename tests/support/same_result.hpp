// Two searches that claim to be the same.
#pragma once

#include <gtest/gtest.h>

#include "mamo/search/search_result.hpp"

namespace mamo::search {

template <class State>
void expect_same(const SearchResult<State>& expected, const SearchResult<State>& actual) {
  EXPECT_EQ(expected.reason, actual.reason);
  EXPECT_EQ(expected.order_hash, actual.order_hash);
  EXPECT_EQ(expected.cost, actual.cost);
  EXPECT_EQ(expected.bound, actual.bound);
  EXPECT_EQ(expected.merged, actual.merged);
  EXPECT_EQ(expected.open_min_f, actual.open_min_f);
  EXPECT_EQ(expected.counters, actual.counters);
  ASSERT_EQ(expected.path.size(), actual.path.size());
  for (std::size_t i = 0; i < expected.path.size(); ++i) {
    EXPECT_EQ(expected.path[i].parent, actual.path[i].parent);
    EXPECT_EQ(expected.path[i].action, actual.path[i].action);
    EXPECT_EQ(expected.path[i].child, actual.path[i].child);
    EXPECT_EQ(expected.path[i].cost, actual.path[i].cost);
  }
}

}  // namespace mamo::search
