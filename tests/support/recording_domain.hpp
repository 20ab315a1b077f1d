// A toy domain that writes down every committed evaluation, in order.
#pragma once

#include <vector>

#include "mamo/search/toy_domain.hpp"

namespace mamo::search {

struct RecordedCommit {
  ToyState parent;
  std::int32_t action;
  bool valid;
  friend bool operator==(const RecordedCommit&, const RecordedCommit&) = default;
};

class RecordingGraph : public RandomGraph {
 public:
  explicit RecordingGraph(const RandomGraphOptions& options) : RandomGraph(options) {}
  std::int32_t on_commit(const ToyState& s, std::int32_t action, const EdgeReport& report) const {
    log.push_back({s, action, report.valid});
    return report.charge;
  }
  mutable std::vector<RecordedCommit> log;
};

}  // namespace mamo::search
