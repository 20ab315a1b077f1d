// What simulated motions led to, kept for a query: an outcome found with some objects is the outcome with any others
// too, as long as those that took part are the same and the rest stay clear of all that moved.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "mamo/model/scene.hpp"
#include "mamo/physics/evaluation.hpp"

namespace mamo {

/// A motion that was simulated: its question and its answer. Immutable once it is in a memo.
struct SimulatedMotion {
  Eigen::VectorXd q0, q1;
  ObjectSet present;  // C_R of the simulation
  WorldState from;
  Evaluation outcome;
};

/// Exact: what find() returns is, bit for bit, what the simulation would give (World: objects that nothing comes near
/// change nothing by being present; Evaluation::took_part and swept say which those are). Safe for several threads.
///
/// Two books are kept, because workers simulate ahead of the search: what is known (find, insert), which depends on
/// threads and saves time only, and what the search on one thread would know (charged), which counters go by.
class OutcomeMemo {
 public:
  /// evaluator: of the scene; asked for the size of objects, not kept.
  OutcomeMemo(const Scene& scene, const Evaluator& evaluator);

  /// Null if nothing is known that answers for these objects.
  std::shared_ptr<const SimulatedMotion> find(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                              const ObjectSet& present, const WorldState& from) const;
  void insert(std::shared_ptr<const SimulatedMotion> motion);

  /// In the order of the search on one thread, for each use of an outcome: would it have had to simulate? `motion`:
  /// what find() or insert() had for these objects; all such are alike.
  bool charged(const SimulatedMotion& motion, const ObjectSet& present, const WorldState& from);

 private:
  struct Charge {
    ObjectSet present;
    WorldState from;
  };
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<std::uint64_t, std::vector<std::shared_ptr<const SimulatedMotion>>> motions;
    std::unordered_map<std::uint64_t, std::vector<Charge>> charges;
  };
  /// Does an outcome with (known, at) hold for (present, from)?
  bool answers(const Evaluation& outcome, const ObjectSet& known, const WorldState& at, const ObjectSet& present,
               const WorldState& from) const;
  Shard& shard(std::uint64_t key) const { return shards_[key % shards_.size()]; }

  std::vector<World::Ball> balls_;  // by object
  mutable std::array<Shard, 16> shards_;
};

}  // namespace mamo
