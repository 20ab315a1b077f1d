#include "mamo/baselines/selsim_retrieval.hpp"

#include <algorithm>

#include "baselines/selsim_retrieval_query.hpp"

namespace mamo {
namespace {

using Settings = std::map<std::string, std::string>;

/// Takes the entries that `docs` names out of `from`.
Settings taken(Settings& from, const std::vector<OptionDoc>& docs) {
  Settings out;
  for (const OptionDoc& doc : docs)
    if (auto entry = from.extract(doc.name)) out.insert(std::move(entry));
  return out;
}

struct Primitives {
  std::string kind = "all";
  OptionTable table() {
    OptionTable t;
    t.add("primitives", kind, {"all", "single"}, "single: one joint per motion, but for the snap onto a goal");
    return t;
  }
};

/// What of the lattice moves several joints at once, switched off where the user says nothing else.
void leave_single_joints(Settings& set) {
  for (const char* name : {"tip_step", "extends", "chains", "own_snap_distance"}) set.insert({name, "0"});
}

class SelSimWithRetrieval final : public Planner {
 public:
  explicit SelSimWithRetrieval(SelSimVariant variant) : variant_(std::move(variant)) {}
  std::string name() const override { return variant_.name; }
  bool can_solve(const Task&) const override { return true; }

  PlanResult plan(const Problem& problem, const PlanOptions& options, const PlanContext& context) override {
    Settings reaching = options.set;
    Primitives primitives;
    primitives.table().apply(taken(reaching, primitives.table().docs()));
    if (primitives.kind == "single") leave_single_joints(reaching);
    if (!std::holds_alternative<Retrieve>(problem.task)) {
      PlanOptions own = options;
      own.set = std::move(reaching);
      return make_selsim_planner(variant_)->plan(problem, own, context);
    }
    SelSimRetrievalOptions settings;
    settings.table().apply(taken(reaching, settings.table().docs()));
    return SelSimRetrievalQuery(variant_, problem, options, context, settings, std::move(reaching)).run();
  }

 private:
  SelSimVariant variant_;
};

}  // namespace

std::unique_ptr<Planner> make_selsim_with_retrieval(const SelSimVariant& variant) {
  return std::make_unique<SelSimWithRetrieval>(variant);
}

std::vector<OptionDoc> selsim_with_retrieval_options() {
  std::vector<OptionDoc> docs = selsim_options();
  for (const OptionTable& table : {Primitives().table(), SelSimRetrievalOptions().table()})
    docs.insert(docs.end(), table.docs().begin(), table.docs().end());
  return docs;
}

}  // namespace mamo
