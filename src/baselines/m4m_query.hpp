// One query of M4M: a single sequence of pushes, never taken back but where the replay refutes it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mamo/rearrangement/rearrangement_query.hpp"

namespace mamo {

struct M4mOptions {
  RearrangementOptions rearrangement;
  int max_rearrangements = 1000;

  M4mOptions() {
    rearrangement.attempts = 200;
    rearrangement.regions = 1;
  }
  OptionTable table() {
    OptionTable t;
    rearrangement.add_to(t);
    t.add("max_rearrangements", max_rearrangements, 1, 1'000'000, "pushes committed to before giving up");
    return t;
  }
};

/// The serial meaning: attempt after attempt, each of an object drawn at random among those that have to move, until
/// one is valid. Attempts are jobs that idle workers compute ahead.
class M4mQuery : public RearrangementQuery {
 public:
  M4mQuery(const Problem& problem, const PlanOptions& options, const PlanContext& context, const M4mOptions& settings)
      : RearrangementQuery("m4m", problem, options, context, settings.rearrangement), settings_(settings) {}

 private:
  struct Attempt {
    ObjectId object;
    std::shared_ptr<PushOutcome> outcome;  // shared with the job, which may outlive the step
    JobBoard::Handle job;
  };

  void search() override;
  std::string what_is_in_the_way() const override;
  bool retrieved();
  bool learn(const Verdict& verdict);
  void push_somebody();
  void push_one_of(const std::vector<ObjectPath>& paths);
  Attempt post(const std::vector<ObjectPath>& paths, int number);
  std::uint64_t content() const;

  const M4mOptions& settings_;
  VoxelVolume region_;
  WorldState state_;                    // after the pushes so far
  std::vector<Step> pushes_;            // committed to
  std::map<std::uint64_t, int> tried_;  // attempts used, by content of the rearrangement
};

}  // namespace mamo
