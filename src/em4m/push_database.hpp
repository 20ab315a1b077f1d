// Successful pushes, to be used again where nothing that mattered has changed (E-M4M, "Caching Successful Push
// Actions").
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mamo/mapf/object_paths.hpp"
#include "mamo/push/push_planner.hpp"

namespace mamo {

class PushDatabase {
 public:
  struct Entry {
    WorldState before;
    std::shared_ptr<const PushOutcome> push;
  };

  void store(const ObjectPath& path, const WorldState& before, std::shared_ptr<const PushOutcome> push);

  /// A push of the same object along the same path whose moved objects stand at `state` exactly as they did, and
  /// which, arm and moved objects both, stays clear of all others where they are now. The oldest that fits.
  std::shared_ptr<const PushOutcome> find(const ObjectPath& path, const WorldState& state,
                                          const std::vector<ObjectId>& movables, PushPlanner& planner) const;

  /// `state` after the push: moved objects where it left them, the others unaffected.
  static WorldState after(const PushOutcome& push, const WorldState& state);

 private:
  using Key = std::pair<ObjectId, std::vector<GridCell>>;
  static Key key_of(const ObjectPath& path);
  std::map<Key, std::vector<Entry>> entries_;
};

}  // namespace mamo
