#include "mamo/selsim/selsim_planner.hpp"

#include "selsim/selsim_query.hpp"

namespace mamo {
namespace {

class SelSimPlanner final : public Planner {
 public:
  explicit SelSimPlanner(SelSimVariant variant) : variant_(std::move(variant)) {}
  std::string name() const override { return variant_.name; }
  bool can_solve(const Task& task) const override { return !std::holds_alternative<Retrieve>(task); }
  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    return SelSimQuery(variant_, problem, options, context).run();
  }

 private:
  SelSimVariant variant_;
};

}  // namespace

std::unique_ptr<Planner> make_selsim_planner(const SelSimVariant& variant) {
  return std::make_unique<SelSimPlanner>(variant);
}

}  // namespace mamo
