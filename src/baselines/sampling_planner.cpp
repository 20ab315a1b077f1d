#include "mamo/baselines/sampling_planner.hpp"

#include "baselines/ompl_query.hpp"

namespace mamo {
namespace {

class SamplingPlanner final : public Planner {
 public:
  explicit SamplingPlanner(SamplingAlgorithm algorithm) : algorithm_(algorithm) {}
  std::string name() const override { return algorithm_ == SamplingAlgorithm::rrt ? "rrt" : "kpiece"; }
  bool can_solve(const Task& task) const override { return std::holds_alternative<Retrieve>(task); }
  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    SamplingOptions settings;
    settings.table().apply(options.set);
    return SamplingQuery(algorithm_, problem, options, context, settings).run();
  }

 private:
  SamplingAlgorithm algorithm_;
};

}  // namespace

std::unique_ptr<Planner> make_sampling_planner(SamplingAlgorithm algorithm) {
  return std::make_unique<SamplingPlanner>(algorithm);
}

std::vector<OptionDoc> sampling_options() { return SamplingOptions().table().docs(); }

}  // namespace mamo
