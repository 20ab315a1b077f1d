// The closed list against oneTBB's map and locked maps: insert, mixed and find, per operation and thread. Keys of 16
// bytes, and (rows ending in _state) the states of a manipulation lattice with seven joints and five relevant objects.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/concurrent_hash_map.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "mamo/common/hash.hpp"
#include "mamo/common/random.hpp"
#include "mamo/lattice/manipulation_lattice.hpp"
#include "mamo/search/closed_list.hpp"

namespace {

using mamo::mix64;

struct Key {
  std::uint64_t a = 0, b = 0;
  friend bool operator==(const Key&, const Key&) = default;
};
using State = mamo::LatticeState;

struct KeyHash {
  std::size_t operator()(const Key& k) const { return mamo::hash_combine(k.a, k.b); }
  std::size_t operator()(const State& s) const {
    mamo::HashStream h;
    h.add(s.anchor);
    for (const std::int32_t b : s.bins) h.add(b);
    for (const mamo::QuantisedPose& pose : s.objects) {
      for (const std::int32_t v : pose.p) h.add(v);
      for (const std::int32_t v : pose.q) h.add(v);
    }
    return h.value();
  }
};

template <class K>
K key_of(std::uint64_t i) {
  if constexpr (std::is_same_v<K, Key>) {
    return {mix64(i), mix64(i ^ 0x5bd1e995)};
  } else {
    State s;
    mamo::RandomStream random(i, {3});
    for (int k = 0; k < 7; ++k) s.bins.push_back(static_cast<std::int32_t>(random.below(360)));
    s.objects.resize(5);
    for (mamo::QuantisedPose& pose : s.objects) {
      for (auto& v : pose.p) v = static_cast<std::int32_t>(random.below(1'000'000));
      for (auto& v : pose.q) v = static_cast<std::int32_t>(random.below(1'000'000));
    }
    return s;
  }
}

/// Keys 0 .. n-1 and as many that are never inserted; made once, so that only the map is timed.
template <class K>
const std::vector<K>& keys_up_to(std::uint64_t n) {
  static std::vector<K> keys;
  for (std::uint64_t i = keys.size(); i < 2 * n; ++i) keys.push_back(key_of<K>(i));
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

template <class K>
class Ours {
 public:
  using Key = K;
  struct Record {
    Key key;
  };
  using Writer = typename mamo::search::ClosedList<Record>::Writer;
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

template <class K>
class TbbMap {
  struct Compare {
    static std::size_t hash(const K& k) { return KeyHash()(k); }
    static bool equal(const K& a, const K& b) { return a == b; }
  };
  using Map = tbb::concurrent_hash_map<K, std::int32_t, Compare>;

 public:
  using Key = K;
  struct Writer {};
  bool insert(const Key& key, Writer&) { return map_.insert(typename Map::value_type{key, 1}); }
  bool find(const Key& key) const {
    typename Map::const_accessor accessor;
    return map_.find(accessor, key);
  }

 private:
  Map map_;
};

template <class K>
class LockedMap {
 public:
  using Key = K;
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

template <class K>
class StripedMap {
 public:
  using Key = K;
  using Writer = typename LockedMap<K>::Writer;
  bool insert(const Key& key, Writer& w) { return stripe(key).insert(key, w); }
  bool find(const Key& key) const { return stripe(key).find(key); }

 private:
  LockedMap<K>& stripe(const Key& key) const { return stripes_[KeyHash()(key) >> 58]; }
  mutable std::unique_ptr<LockedMap<K>[]> stripes_ = std::make_unique<LockedMap<K>[]>(64);
};

/// One per map type; thread 0 sets it up and checks the answers before anything is timed.
template <class Map>
std::unique_ptr<Map> shared;

template <class Map>
void fill(Map& map, std::uint64_t begin, std::uint64_t end, typename Map::Writer& writer) {
  for (std::uint64_t i = begin; i < end; ++i) map.insert(key_of<typename Map::Key>(i), writer);
}

template <class Map>
void check(std::uint64_t keys) {
  Map map;
  typename Map::Writer writer;
  fill(map, 0, keys, writer);
  std::uint64_t signature = 0;
  for (std::uint64_t i = 0; i < 2 * keys; ++i) signature = mamo::hash_combine(signature, map.find(key_of<typename Map::Key>(i)));
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
  const auto& keys = keys_up_to<typename Map::Key>(share.all);
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
  const auto& keys = keys_up_to<typename Map::Key>(share.all);
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
  const auto& keys = keys_up_to<typename Map::Key>(share.all);
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
  keys_up_to<typename Map::Key>(n);
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
    b->Arg(100'000)->Threads(1)->Threads(2)->Iterations(1)->UseRealTime();
    if (std::is_same_v<typename Map::Key, Key>) b->Arg(1'000'000);
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
  add<Ours<Key>>("closed_list");
  add<TbbMap<Key>>("tbb_hash_map");
  add<LockedMap<Key>>("mutex_map");
  add<StripedMap<Key>>("striped_64");
  add<Ours<State>>("closed_list_state");
  add<TbbMap<State>>("tbb_hash_map_state");
  add<LockedMap<State>>("mutex_map_state");
  std::uint64_t signature = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) signature = mamo::hash_combine(signature, KeyHash()(key_of<Key>(i)));
  benchmark::AddCustomContext("signature", mamo::to_hex(signature));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
