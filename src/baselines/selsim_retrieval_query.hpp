// One query of a selective-simulation planner that has to fetch something.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "baselines/grasp_query.hpp"

#include "mamo/selsim/selsim_planner.hpp"

namespace mamo {

struct SelSimRetrievalOptions {
  GraspOptions grasp;
  int way_expansions = 200;
  int rounds = 12;

  OptionTable table() {
    OptionTable t;
    grasp.add_to(t);
    t.add("way_expansions", way_expansions, 1, 1'000'000'000,
          "retrieve: expansions for the first search towards a grasp, doubled each round");
    t.add("rounds", rounds, 1, 30, "retrieve: rounds over the grasps");
    return t;
  }
};

class SelSimRetrievalQuery final : public GraspQuery {
 public:
  /// `set`: what the reach planner understands.
  SelSimRetrievalQuery(const SelSimVariant& variant, const Problem& problem, const PlanOptions& options,
                       const PlanContext& context, const SelSimRetrievalOptions& settings,
                       std::map<std::string, std::string> set)
      : GraspQuery(variant.name, problem, options, context, settings.grasp),
        variant_(variant),
        context_(context),
        settings_(settings),
        set_(std::move(set)) {}

 private:
  void search() override;
  /// True: this way has no more to give.
  bool tried(const RetrievalPath& way, std::int64_t expansions);
  PlanResult reach(const RetrievalPath& way, std::int64_t expansions);
  void take_over(const PlanResult& reached);

  const SelSimVariant variant_;
  const PlanContext& context_;
  const SelSimRetrievalOptions& settings_;
  const std::map<std::string, std::string> set_;
};

}  // namespace mamo
