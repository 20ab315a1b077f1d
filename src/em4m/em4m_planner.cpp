#include "mamo/em4m/em4m_planner.hpp"

#include "em4m/em4m_query.hpp"

namespace mamo {
namespace {

class Em4mPlanner : public Planner {
 public:
  explicit Em4mPlanner(Em4mVariant variant) : variant_(std::move(variant)) {}
  std::string name() const override { return variant_.name; }
  bool can_solve(const Task& task) const override { return std::holds_alternative<Retrieve>(task); }
  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    Em4mOptions settings;
    settings.table().apply(options.set);
    settings.rearrangement.paths.neighbour_penalties = variant_.negative_cache;
    return Em4mQuery(variant_, problem, options, context, settings).run();
  }

 private:
  Em4mVariant variant_;
};

}  // namespace

std::unique_ptr<Planner> make_em4m_planner(const Em4mVariant& variant) {
  return std::make_unique<Em4mPlanner>(variant);
}

std::vector<OptionDoc> em4m_options() { return Em4mOptions().table().docs(); }

}  // namespace mamo
