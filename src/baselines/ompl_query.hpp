// One query of a sampling-based planner of OMPL's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "baselines/grasp_query.hpp"

#include "mamo/baselines/sampling_planner.hpp"

namespace mamo {

struct SamplingOptions {
  GraspOptions grasp;
  int max_propagations = 1'000'000;
  int trees = 100;
  double goal_distance = 0.05;

  OptionTable table() {
    OptionTable t;
    grasp.add_to(t);
    t.add("max_propagations", max_propagations, 1, 1'000'000'000, "steps tried before giving up");
    t.add("trees", trees, 1, 1'000'000, "trees grown, another one whenever verification rejects a plan");
    t.add("goal_distance", goal_distance, 0.0, 10.0, "distance in joint space from which the pre-grasp is tried (rad)");
    return t;
  }
};

class SamplingQuery final : public GraspQuery {
 public:
  SamplingQuery(SamplingAlgorithm algorithm, const Problem& problem, const PlanOptions& options,
                const PlanContext& context, const SamplingOptions& settings);

 private:
  class Motions;
  class Goal;
  struct Tree;

  void search() override;
  bool grow(std::uint64_t seed);
  bool at_an_end();
  std::unique_ptr<Tree> plant(std::uint64_t seed);
  EdgeResult propagate(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from);
  double free_share(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from);

  const SamplingAlgorithm algorithm_;
  const SamplingOptions& settings_;
};

}  // namespace mamo
