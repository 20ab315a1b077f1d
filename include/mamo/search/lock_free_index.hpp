// A lock-free, insert-only, growing hash index: hash -> id of an entry that is stored elsewhere.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace mamo::search {

/// Open addressing, linear probing, a power of two of 64-bit slots. A slot goes through one change in its life:
///
///     0 (empty) ──► word = [32-bit tag of the hash | id + 1]      an entry, for good
///               └─► kFrozen                                       nothing will ever be here: look in the next table
///
/// The index never stores keys: insert() and find() take `equal(id)`, which compares the full key of entry `id` with
/// the one that is looked for. The tag only saves calls of it; a hash is never identity.
///
/// Growth stops nobody. A table that may become half full gets a `next` of four times the size. From then on an
/// inserter that comes to an empty slot freezes it instead of filling it and goes on in `next`; each such visit also
/// moves a chunk of slots over (freezing the empty ones, copying the words). Once all are moved, `root` is set to
/// `next`.
///
/// Why a key cannot enter twice. The probe path of a key in one table is a fixed sequence of slots. Slots are
/// filled along it without gaps, and neither words nor kFrozen ever change. So all inserters of one key find the
/// same first slot that is not a word: one of them turns it into the key's word, and the others then see it (and
/// call it equal), or one freezes it, and then all of them, now and later, fail to find the key here and meet again
/// in `next`. A copied word cannot meet an equal key in `next`, because nobody gets there past a word equal to his.
///
/// Memory ordering, load by load:
///   slot CAS (0 -> word)   release: the entry's payload, written plainly before, is visible to whoever reads the word.
///   slot CAS failure, slot load   acquire: pairs with it; so equal(id) may read the payload plainly.
///   next.store             release (in a CAS): the new table's zeroed slots and mask are visible with the pointer.
///   next.load              acquire: pairs with it. Whoever reads kFrozen also sees next != null: the freezer had read
///                          it before its releasing CAS, and the reader's load of the slot acquires that.
///   root.load              acquire: pairs with the CAS that promotes. An old root leads to the new one.
///   moved, promotion       sequentially consistent: of two threads that finish two tables at once, at least one sees
///                          the other's, so that root is promoted past both. Only speed is at stake.
/// No ABA: nothing is removed; tables live as long as the index. find() is wait-free but for growth, which can add a
/// table to its way each time; insert() is lock-free: a stalled thread hinders nobody.
///
/// Prior art: linear probing with claimed slots and cooperative copying as in Cliff Click's non-blocking hash map
/// (2007) and growt (Maier, Sanders, Dementiev 2016); insert-only ids as in folly's AtomicUnorderedInsertMap.
class LockFreeIndex {
 public:
  static constexpr std::int32_t kNone = -1;

  explicit LockFreeIndex(std::size_t initial_slots = 1024) {
    first_ = new Table(round_up(initial_slots));
    root_.store(first_, std::memory_order_release);
  }
  ~LockFreeIndex() {
    for (Table* t = first_; t;) {
      Table* next = t->next.load(std::memory_order_relaxed);
      delete t;
      t = next;
    }
  }
  LockFreeIndex(const LockFreeIndex&) = delete;
  LockFreeIndex& operator=(const LockFreeIndex&) = delete;

  /// The id of the entry with this hash for which equal(id) holds, or kNone.
  template <class Equal>
  std::int32_t find(std::uint64_t hash, Equal&& equal) const {
    const std::uint32_t tag = tag_of(hash);
    for (const Table* table = root_.load(std::memory_order_acquire);; table = table->next_table()) {
      for (std::size_t slot = tag & table->mask;; slot = (slot + 1) & table->mask) {
        const std::uint64_t word = table->load(slot);
        if (word == kEmpty) return kNone;  // whoever inserts the key would have to pass this slot first
        if (word == kFrozen) break;
        if (static_cast<std::uint32_t>(word >> 32) == tag && equal(id_of(word))) return id_of(word);
      }
    }
  }

  /// The id of the entry with this hash for which equal(id) holds; if there is none, enters the id that make() gives.
  /// make() is called at most once, and perhaps in vain: when another thread enters an equal entry at the same time.
  /// reserve() must have been called for at least as many entries as there will be with this one.
  template <class Equal, class Make>
  std::int32_t insert(std::uint64_t hash, Equal&& equal, Make&& make) {
    const std::uint32_t tag = tag_of(hash);
    std::int32_t made = kNone;
    for (Table* table = root_.load(std::memory_order_acquire);; table = table->next_table()) {
      for (std::size_t slot = tag & table->mask;; slot = (slot + 1) & table->mask) {
        std::uint64_t word = table->load(slot);
        if (word == kEmpty) {
          if (made == kNone) made = make();  // may begin growth
          const std::uint64_t desired = table->next_table() ? kFrozen : word_of(tag, made);
          if (table->claim(slot, word, desired)) {
            if (desired != kFrozen) return made;
            word = kFrozen;
          }
        }
        if (word == kFrozen) break;
        if (static_cast<std::uint32_t>(word >> 32) == tag && equal(id_of(word))) return id_of(word);
      }
      help_move(*table);
    }
  }

  /// Makes sure that `entries` fill at most half of some table: growth begins here.
  void reserve(std::size_t entries) {
    Table* table = root_.load(std::memory_order_acquire);
    while (2 * entries > table->mask + 1) {
      Table* next = table->next_table();
      if (!next) {
        auto grown = std::make_unique<Table>(kGrowth * (table->mask + 1));
        // Failure (acquire): another thread was quicker and its table is used.
        if (table->next.compare_exchange_strong(next, grown.get(), std::memory_order_release,
                                                std::memory_order_acquire)) {
          next = grown.release();
        }
      }
      table = next;
    }
  }

  /// Slots of the table that look-ups start in.
  std::size_t slots() const { return root_.load(std::memory_order_acquire)->mask + 1; }

 private:
  static constexpr std::uint64_t kEmpty = 0, kFrozen = ~std::uint64_t{0};
  static constexpr std::size_t kChunk = 64;  // slots moved per visit
  static constexpr std::size_t kGrowth = 4;

  struct Table {
    explicit Table(std::size_t slots)
        : mask(slots - 1), words(static_cast<std::uint64_t*>(std::calloc(slots, sizeof(std::uint64_t)))) {
      if (!words) throw std::bad_alloc();
    }
    ~Table() { std::free(words); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    std::uint64_t load(std::size_t slot) const {
      return std::atomic_ref<std::uint64_t>(words[slot]).load(std::memory_order_acquire);
    }
    /// CAS 0 -> desired; on failure `seen` is what is there.
    bool claim(std::size_t slot, std::uint64_t& seen, std::uint64_t desired) {
      seen = kEmpty;
      return std::atomic_ref<std::uint64_t>(words[slot])
          .compare_exchange_strong(seen, desired, std::memory_order_release, std::memory_order_acquire);
    }
    Table* next_table() const { return next.load(std::memory_order_acquire); }

    const std::size_t mask;
    std::uint64_t* const words;         // calloc: untouched pages cost nothing
    std::atomic<Table*> next{nullptr};  // set once, when growth begins
    std::atomic<std::size_t> taken{0};  // chunks handed out for moving: slots so far
    std::atomic<std::size_t> moved{0};  // slots moved
  };

  static std::size_t round_up(std::size_t slots) {
    std::size_t n = kChunk;
    while (n < slots) n *= 2;
    return n;
  }
  /// Also the home slot, in its low bits: so a word can be moved without its hash.
  static std::uint32_t tag_of(std::uint64_t hash) {
    return static_cast<std::uint32_t>(((hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15ull) >> 32);
  }
  static std::uint64_t word_of(std::uint32_t tag, std::int32_t id) {
    return static_cast<std::uint64_t>(tag) << 32 | (static_cast<std::uint32_t>(id) + 1u);
  }
  static std::int32_t id_of(std::uint64_t word) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word) - 1u);
  }

  /// Moves one chunk of a table that has a successor, if any is left.
  void help_move(Table& table) {
    const std::size_t size = table.mask + 1;
    if (table.taken.load(std::memory_order_relaxed) >= size) return;
    const std::size_t begin = table.taken.fetch_add(kChunk, std::memory_order_relaxed);
    if (begin >= size) return;
    for (std::size_t slot = begin; slot < begin + kChunk; ++slot) {
      std::uint64_t word = table.load(slot);
      if (word == kEmpty && table.claim(slot, word, kFrozen)) continue;
      if (word != kFrozen) copy(word, table.next_table());
    }
    if (table.moved.fetch_add(kChunk, std::memory_order_seq_cst) + kChunk == size) promote();
  }

  /// Enters a word that is in an older table. Its key is in no newer one.
  static void copy(std::uint64_t moving, Table* table) {
    const auto tag = static_cast<std::uint32_t>(moving >> 32);
    for (;; table = table->next_table()) {
      for (std::size_t slot = tag & table->mask;; slot = (slot + 1) & table->mask) {
        std::uint64_t word = table->load(slot);
        if (word == kEmpty) {
          const std::uint64_t desired = table->next_table() ? kFrozen : moving;
          if (table->claim(slot, word, desired)) {
            if (desired == moving) return;
            word = kFrozen;
          }
        }
        if (word == kFrozen) break;
      }
    }
  }

  /// Sets root past all tables that have been moved whole.
  void promote() {
    Table* table = root_.load(std::memory_order_seq_cst);
    while (table->moved.load(std::memory_order_seq_cst) == table->mask + 1) {
      Table* next = table->next_table();
      if (root_.compare_exchange_strong(table, next, std::memory_order_seq_cst)) table = next;
    }
  }

  std::atomic<Table*> root_;
  Table* first_;
};

}  // namespace mamo::search
