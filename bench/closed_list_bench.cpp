// The closed list against oneTBB's map and locked maps: insert, mixed and find, per operation and thread.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/concurrent_hash_map.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "mamo/common/random.hpp"
#include "mamo/search/closed_list.hpp"

namespace {

using mamo::mix64;

struct Key {
  std::uint64_t a = 0, b = 0;
  friend bool operator==(const Key&, const Key&) = default;
};
struct KeyHash {
  std::size_t operator()(const Key& k) const { return mamo::hash_combine(k.a, k.b); }
};
Key key_of(std::uint64_t i) { return {mix64(i), mix64(i ^ 0x5bd1e995)}; }

/// Keys 0 .. n-1 and as many that are never inserted; made once, so that only the map is timed.
const std::vector<Key>& keys_up_to(std::uint64_t n) {
  static std::vector<Key> keys;
  for (std::uint64_t i = keys.size(); i < 2 * n; ++i) keys.push_back(key_of(i));
  return keys;
}
/// The numbers 0 .. n-1, shuffled.
const std::vector<std::uint32_t>& shuffled(std::uint64_t n) {
  static std::map<std::uint64_t, std::vector<std::uint32_t>> orders;
  std::vector<std::uint32_t>& order = orders[n];
  mamo::RandomStream random(2, {n});
  for (std::uint64_t i = order.size(); i < n; ++i) {
    order.push_back(static_cast<std::uint32_t>(i));
    std::swap(order.back(), order[random.below(i + 1)]);
  }
  return order;
}

class Ours {
 public:
  struct Record {
    Key key;
  };
  using Writer = mamo::search::ClosedList<Record>::Writer;
  bool insert(const Key& key, Writer& writer) {
    return list_
        .insert(
            KeyHash()(key), writer, [&](const Record& r) { return r.key == key; },
            [&](Record& r, std::int32_t) { r.key = key; })
        .second;
  }
  bool find(const Key& key) const {
    return list_.find(KeyHash()(key), [&](const Record& r) { return r.key == key; }) >= 0;
  }

 private:
  mamo::search::ClosedList<Record> list_;
};

class TbbMap {
  struct Compare {
    static std::size_t hash(const Key& k) { return KeyHash()(k); }
    static bool equal(const Key& a, const Key& b) { return a == b; }
  };
  using Map = tbb::concurrent_hash_map<Key, std::int32_t, Compare>;

 public:
  struct Writer {};
  bool insert(const Key& key, Writer&) { return map_.insert(Map::value_type{key, 1}); }
  bool find(const Key& key) const {
    Map::const_accessor accessor;
    return map_.find(accessor, key);
  }

 private:
  Map map_;
};

class LockedMap {
 public:
  struct Writer {};
  bool insert(const Key& key, Writer&) {
    std::lock_guard lock(mutex_);
    return map_.emplace(key, 1).second;
  }
  bool find(const Key& key) const {
    std::lock_guard lock(mutex_);
    return map_.find(key) != map_.end();
  }

 private:
  mutable std::mutex mutex_;
  std::unordered_map<Key, std::int32_t, KeyHash> map_;
};

class StripedMap {
 public:
  using Writer = LockedMap::Writer;
  bool insert(const Key& key, Writer& w) { return stripe(key).insert(key, w); }
  bool find(const Key& key) const { return stripe(key).find(key); }

 private:
  LockedMap& stripe(const Key& key) const { return stripes_[KeyHash()(key) >> 58]; }
  mutable std::unique_ptr<LockedMap[]> stripes_ = std::make_unique<LockedMap[]>(64);
};

/// One per map type; thread 0 sets it up and checks the answers before anything is timed.
template <class Map>
std::unique_ptr<Map> shared;

template <class Map>
void fill(Map& map, std::uint64_t begin, std::uint64_t end, typename Map::Writer& writer) {
  for (std::uint64_t i = begin; i < end; ++i) map.insert(key_of(i), writer);
}

template <class Map>
void check(std::uint64_t keys) {
  Map map;
  typename Map::Writer writer;
  fill(map, 0, keys, writer);
  std::uint64_t signature = 0;
  for (std::uint64_t i = 0; i < 2 * keys; ++i) signature = mamo::hash_combine(signature, map.find(key_of(i)));
  std::uint64_t expected = 0;
  for (std::uint64_t i = 0; i < 2 * keys; ++i) expected = mamo::hash_combine(expected, i < keys);
  if (signature != expected) std::fprintf(stderr, "closed_list_bench: wrong answer\n"), std::abort();
}

/// What thread t of T works on.
struct Share {
  explicit Share(const benchmark::State& state)
      : all(static_cast<std::uint64_t>(state.range(0))),
        size(all / static_cast<std::uint64_t>(state.threads())),
        first(static_cast<std::uint64_t>(state.thread_index()) * size) {}
  std::uint64_t all, size, first;
};

/// Each thread inserts its share.
template <class Map>
void insert(benchmark::State& state) {
  const Share share(state);
  const std::vector<Key>& keys = keys_up_to(share.all);
  for (auto _ : state) {
    typename Map::Writer writer;
    for (std::uint64_t i = share.first; i < share.first + share.size; ++i) shared<Map>->insert(keys[i], writer);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(share.size));
}

/// Three of four operations look up a key, half of which have been inserted before.
template <class Map>
void mixed(benchmark::State& state) {
  const Share share(state);
  const std::vector<Key>& keys = keys_up_to(share.all);
  std::uint64_t hits = 0;
  for (auto _ : state) {
    typename Map::Writer writer;
    std::uint64_t inserted = share.first, seed = share.first;
    for (std::uint64_t i = 0; i < share.size; ++i) {
      if (i % 4 == 0) {
        shared<Map>->insert(keys[inserted++], writer);
      } else {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        const std::uint64_t draw = (seed >> 32) * (inserted - share.first) >> 32;
        hits += shared<Map>->find(keys[share.first + draw + (i % 2 ? share.all : 0)]);
      }
    }
  }
  benchmark::DoNotOptimize(hits);
  state.SetItemsProcessed(static_cast<std::int64_t>(share.size));
}

template <class Map>
void find(benchmark::State& state) {
  const Share share(state);
  const std::vector<Key>& keys = keys_up_to(share.all);
  const std::vector<std::uint32_t>& order = shuffled(share.all);
  std::uint64_t hits = 0;
  for (auto _ : state) {
    for (std::uint64_t i = share.first; i < share.first + share.size; ++i) hits += shared<Map>->find(keys[order[i]]);
  }
  if (hits != share.size) std::fprintf(stderr, "closed_list_bench: wrong answer\n"), std::abort();
  state.SetItemsProcessed(static_cast<std::int64_t>(share.size));
}

template <class Map, bool filled>
void setup(const benchmark::State& state) {
  const auto n = static_cast<std::uint64_t>(state.range(0));
  keys_up_to(n);
  shuffled(n);
  shared<Map> = std::make_unique<Map>();
  typename Map::Writer writer;
  if (filled) fill(*shared<Map>, 0, n, writer);
}
template <class Map>
void teardown(const benchmark::State&) {
  shared<Map>.reset();
}

template <class Map>
void add(const std::string& name) {
  check<Map>(20'000);
  const auto one = [&](const std::string& what, void (*function)(benchmark::State&),
                       void (*prepare)(const benchmark::State&)) {
    auto* b = benchmark::RegisterBenchmark((what + "/" + name).c_str(), function);
    b->Arg(100'000)->Arg(1'000'000)->Threads(1)->Threads(2)->Iterations(1)->UseRealTime();
    b->Setup(prepare)->Teardown(teardown<Map>)->Unit(benchmark::kMillisecond);
    b->ComputeStatistics("min", [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); });
    b->ComputeStatistics("max", [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); });
  };
  one("insert", insert<Map>, setup<Map, false>);
  one("mixed", mixed<Map>, setup<Map, false>);
  one("find", find<Map>, setup<Map, true>);
}

}  // namespace

int main(int argc, char** argv) {
  add<Ours>("closed_list");
  add<TbbMap>("tbb_hash_map");
  add<LockedMap>("mutex_map");
  add<StripedMap>("striped_64");
  std::uint64_t signature = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) signature = mamo::hash_combine(signature, KeyHash()(key_of(i)));
  std::printf("signature: %016" PRIx64 "\n", signature);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
