#include "mamo/baselines/dogar_planner.hpp"

#include "baselines/dogar_query.hpp"

namespace mamo {
namespace {

class DogarPlanner final : public Planner {
 public:
  std::string name() const override { return "dogar"; }
  bool can_solve(const Task& task) const override { return std::holds_alternative<Retrieve>(task); }
  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    DogarOptions settings;
    settings.table().apply(options.set);
    return DogarQuery(problem, options, context, settings).run();
  }
};

}  // namespace

std::unique_ptr<Planner> make_dogar_planner() { return std::make_unique<DogarPlanner>(); }

std::vector<OptionDoc> dogar_options() { return DogarOptions().table().docs(); }

}  // namespace mamo
