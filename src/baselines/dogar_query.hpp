// One query of the planner that goes backwards in time over negative goal regions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mamo/common/random.hpp"
#include "mamo/rearrangement/rearrangement_query.hpp"

namespace mamo {

struct DogarOptions {
  RearrangementOptions rearrangement;
  int draws = 1000;  // whole plans drawn
  int budget = 100;  // attempts of one draw

  OptionTable table() {
    OptionTable t;
    rearrangement.add_to(t);
    t.add("draws", draws, 1, 1'000'000, "sequences of pushes drawn anew, after one failed or was rejected");
    t.add("budget", budget, 1, 1'000'000, "pushes tried in one draw");
    return t;
  }
};

/// The serial meaning: draw by draw, objects in the region in random order, attempts by number. The attempts at one
/// object are jobs that idle workers compute ahead.
class DogarQuery : public RearrangementQuery {
 public:
  DogarQuery(const Problem& problem, const PlanOptions& options, const PlanContext& context,
             const DogarOptions& settings)
      : RearrangementQuery("dogar", problem, options, context, settings.rearrangement), settings_(settings) {}

 private:
  /// What has been planned of the end of a plan.
  struct Tail {
    VoxelVolume region;        // to be free before all of it
    std::vector<Step> pushes;  // the last one in time first
    ObjectSet planned;         // objects of these pushes
  };
  struct Attempt {
    std::shared_ptr<PushOutcome> outcome;  // shared with the job
    JobBoard::Handle job;
  };

  void search() override;
  std::string what_is_in_the_way() const override;
  bool submitted(const Tail& tail);
  std::vector<ObjectId> inside(const Tail& tail) const;
  bool clear(Tail& tail);
  std::optional<Tail> push_out(const Tail& tail, ObjectId object, RandomStream random);
  bool out_of_region(const Tail& tail, ObjectId object, const PushOutcome& outcome);
  Tail extended(const Tail& tail, ObjectId object, std::shared_ptr<const PushOutcome> push) const;
  WorldState set_aside(const Tail& tail, ObjectId object) const;
  std::optional<Eigen::Vector2d> place_outside(const Tail& tail, ObjectId object, RandomStream& random) const;
  std::vector<Attempt> post(const Tail& tail, ObjectId object, RandomStream& random);
  bool out_of_budget();

  const DogarOptions& settings_;
  WorldState start_;
  Eigen::AlignedBox3d space_;
  std::uint64_t node_ = 0;     // regions looked at so far: names random streams
  int draw_ = 0;               // draws so far
  std::int64_t attempts_ = 0;  // of the present draw
};

}  // namespace mamo
