// The lock-free closed list: one winner per key, the same id for all, linearizable, through growth.
#include "mamo/search/closed_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <set>
#include <unordered_map>

#include "support/toy_graphs.hpp"

#include "mamo/common/executor.hpp"
#include "mamo/common/random.hpp"
#include "mamo/search/state_table.hpp"

namespace mamo::search {
namespace {

struct Entry {
  std::uint64_t key = 0, check = 0;
};

enum class Hashing { good, few_slots, one_value };

std::uint64_t hash_of(std::uint64_t key, Hashing hashing) {
  if (hashing == Hashing::good) return mix64(key);
  return hashing == Hashing::few_slots ? key % 16 : 7;
}

std::pair<std::int32_t, bool> insert(ClosedList<Entry>& list, ClosedList<Entry>::Writer& writer, std::uint64_t key,
                                     Hashing hashing) {
  return list.insert(
      hash_of(key, hashing), writer, [&](const Entry& e) { return e.key == key; },
      [&](Entry& e, std::int32_t) {
        e.key = key;
        e.check = mix64(key);
      });
}
std::int32_t find(const ClosedList<Entry>& list, std::uint64_t key, Hashing hashing) {
  return list.find(hash_of(key, hashing), [&](const Entry& e) { return e.key == key; });
}

std::vector<std::uint64_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::uint64_t> keys(n);
  std::iota(keys.begin(), keys.end(), 1);
  RandomStream random(seed, {});
  for (std::size_t i = n; i > 1; --i) std::swap(keys[i - 1], keys[random.below(i)]);
  return keys;
}

TEST(ClosedList, InsertsFindsAndGrowsOnOneThread) {
  ClosedList<Entry> list(64);
  ClosedList<Entry>::Writer writer;
  for (std::uint64_t k = 1; k <= 50'000; ++k) {
    EXPECT_EQ(find(list, k, Hashing::good), ClosedList<Entry>::kNone);
    const auto [id, fresh] = insert(list, writer, k, Hashing::good);
    ASSERT_TRUE(fresh);
    ASSERT_EQ(id, static_cast<std::int32_t>(k - 1));
    ASSERT_FALSE(insert(list, writer, k / 2 + 1, Hashing::good).second && k > 1);
  }
  for (std::uint64_t k = 1; k <= 50'000; ++k) ASSERT_EQ(list[find(list, k, Hashing::good)].key, k);
  EXPECT_EQ(find(list, 50'001, Hashing::good), ClosedList<Entry>::kNone);
  EXPECT_GE(list.slots(), 65'536u) << "look-ups start in the grown table";
}

class ClosedListStress : public testing::TestWithParam<std::tuple<int, Hashing>> {};

TEST_P(ClosedListStress, EveryKeyHasOneWinnerAndOneIdWhileTheTableGrows) {
  const auto [threads, hashing] = GetParam();
  const std::size_t n = hashing == Hashing::good ? 6000 : 500;
  Executor executor(threads);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    ClosedList<Entry> list(64);
    std::vector<std::vector<std::int32_t>> ids(static_cast<std::size_t>(threads), std::vector<std::int32_t>(n + 1));
    std::vector<std::vector<std::uint64_t>> won(static_cast<std::size_t>(threads));
    executor.run([&](WorkerId w) {
      ClosedList<Entry>::Writer writer;
      for (const std::uint64_t key : shuffled(n, seed * 100 + w.index())) {
        const auto [id, fresh] = insert(list, writer, key, hashing);
        ids[w.index()][key] = id;
        if (fresh) won[w.index()].push_back(key);
        if (list[id].key != key || list[id].check != mix64(key)) std::abort();  // a payload seen too early
        if (find(list, key, hashing) != id) std::abort();
      }
    });
    std::vector<int> winners(n + 1);
    for (const auto& keys : won) {
      for (const std::uint64_t key : keys) ++winners[key];
    }
    std::set<std::int32_t> distinct;
    for (std::size_t key = 1; key <= n; ++key) {
      ASSERT_EQ(winners[key], 1) << "key " << key << " seed " << seed;
      for (const auto& seen : ids) ASSERT_EQ(seen[key], ids[0][key]);
      distinct.insert(ids[0][key]);
    }
    EXPECT_EQ(distinct.size(), n);
  }
}

// Threads insert and find keys of a small range; every operation takes an invocation and a response number from one
// counter. For an insert-only set linearizability is a matter of each key alone: exactly one insert is new; no find
// that begins after an insert of the key has ended misses it; and no find that ends before the first insert of the key
// begins hits.
TEST_P(ClosedListStress, IsLinearizable) {
  const auto [threads, hashing] = GetParam();
  struct Operation {
    std::uint64_t key;
    bool insert, hit;  // hit: the key was there (insert: before)
    std::uint64_t invoked, returned;
  };
  Executor executor(threads);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    ClosedList<Entry> list(64);
    std::atomic<std::uint64_t> clock{0};
    std::vector<std::vector<Operation>> logs(static_cast<std::size_t>(threads));
    executor.run([&](WorkerId w) {
      ClosedList<Entry>::Writer writer;
      RandomStream random(seed, {w.index()});
      for (int i = 0; i < 1500; ++i) {
        Operation op{1 + random.below(hashing == Hashing::good ? 1000 : 200), random.below(3) == 0, false, 0, 0};
        op.invoked = clock.fetch_add(1);
        op.hit = op.insert ? !insert(list, writer, op.key, hashing).second
                           : find(list, op.key, hashing) != ClosedList<Entry>::kNone;
        op.returned = clock.fetch_add(1);
        logs[w.index()].push_back(op);
      }
    });
    struct Key {
      int fresh = 0;
      std::uint64_t first_invoked = UINT64_MAX, first_returned = UINT64_MAX;
    };
    std::unordered_map<std::uint64_t, Key> keys;
    for (const auto& log : logs) {
      for (const Operation& op : log) {
        if (!op.insert) continue;
        Key& key = keys[op.key];
        key.fresh += !op.hit;
        key.first_invoked = std::min(key.first_invoked, op.invoked);
        key.first_returned = std::min(key.first_returned, op.returned);
      }
    }
    for (const auto& [name, key] : keys) ASSERT_EQ(key.fresh, 1) << "key " << name << " seed " << seed;
    for (const auto& log : logs) {
      for (const Operation& op : log) {
        if (op.insert) continue;
        const Key key = keys.count(op.key) ? keys[op.key] : Key{};
        ASSERT_FALSE(!op.hit && op.invoked > key.first_returned) << "a find missed key " << op.key << " seed " << seed;
        ASSERT_FALSE(op.hit && op.returned < key.first_invoked) << "key " << op.key << " seed " << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, ClosedListStress,
                         testing::Combine(testing::Values(1, 2, 4, 8),
                                          testing::Values(Hashing::good, Hashing::few_slots, Hashing::one_value)));

TEST(SegmentedArena, KeepsAddressesAndCountsBlocks) {
  SegmentedArena<Entry> arena;
  std::vector<Entry*> seen;
  for (int block = 0; block < 200; ++block) {
    const std::int32_t begin = arena.take_block();
    EXPECT_EQ(begin, block * SegmentedArena<Entry>::kBlock);
    for (std::int32_t i = begin; i < begin + SegmentedArena<Entry>::kBlock; ++i) {
      arena[i].key = static_cast<std::uint64_t>(i);
      seen.push_back(&arena[i]);
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ASSERT_EQ(seen[i], &arena[static_cast<std::int32_t>(i)]);
    ASSERT_EQ(seen[i]->key, i);
  }
}

TEST(StateTable, ThreadsAgreeOnStatesAndClasses) {
  RandomGraphOptions options;
  options.nodes = 40;
  options.labels = 12;
  options.class_size = 4;
  const RandomGraph domain(options);
  Executor executor(4);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    StateTable<RandomGraph> table(domain);
    std::vector<std::unordered_map<std::uint64_t, StateId>> ids(4);
    executor.run([&](WorkerId w) {
      StateTable<RandomGraph>::Writer writer;
      RandomStream random(seed, {w.index()});
      for (int i = 0; i < 400; ++i) {
        const ToyState s{static_cast<std::int32_t>(random.below(40)), static_cast<std::int32_t>(random.below(12))};
        const StateId id = table.intern(s, writer);
        ids[w.index()].emplace(domain.hash(s), id);
        if (table.state(id) != s) std::abort();
      }
    });
    std::unordered_map<std::uint64_t, StateId> representative;
    for (std::int32_t node = 0; node < 40; ++node) {
      for (std::int32_t label = 0; label < 12; ++label) {
        const ToyState s{node, label};
        const StateId id = table.find(s);
        for (const auto& seen : ids) {
          const auto it = seen.find(domain.hash(s));
          if (it != seen.end()) {
            ASSERT_EQ(it->second, id);
          }
        }
        if (!id.valid()) continue;
        ASSERT_EQ(table.closed_by(id), kNoState);
        const auto [it, fresh] = representative.emplace(domain.class_hash(s), table.class_of(id));
        ASSERT_EQ(it->second, table.class_of(id)) << "one class, two representatives";
        table.close(id);
        ASSERT_EQ(table.closed_by({node, label ^ 1}), id);
        break;
      }
    }
  }
}

}  // namespace
}  // namespace mamo::search
