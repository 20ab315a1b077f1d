#include "mamo/baselines/m4m_planner.hpp"

#include "baselines/m4m_query.hpp"

namespace mamo {
namespace {

class M4mPlanner final : public Planner {
 public:
  std::string name() const override { return "m4m"; }
  bool can_solve(const Task& task) const override { return std::holds_alternative<Retrieve>(task); }
  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    M4mOptions settings;
    settings.table().apply(options.set);
    return M4mQuery(problem, options, context, settings).run();
  }
};

}  // namespace

std::unique_ptr<Planner> make_m4m_planner() { return std::make_unique<M4mPlanner>(); }

std::vector<OptionDoc> m4m_options() { return M4mOptions().table().docs(); }

}  // namespace mamo
