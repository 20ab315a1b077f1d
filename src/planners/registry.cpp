#include "mamo/planners/registry.hpp"

#include "mamo/baselines/dogar_planner.hpp"
#include "mamo/baselines/m4m_planner.hpp"
#include "mamo/baselines/sampling_planner.hpp"
#include "mamo/baselines/selsim_retrieval.hpp"
#include "mamo/em4m/em4m_planner.hpp"

namespace mamo {

#define MAMO_PLANNER(name, make, options) \
  std::unique_ptr<Planner> make();        \
  std::vector<OptionDoc> options();
#include "planners/one_file_planners.inc"
#undef MAMO_PLANNER

namespace {

struct Entry {
  std::string name;
  std::unique_ptr<Planner> (*make)();
  std::vector<OptionDoc> (*options)();
};

template <bool kSelective, bool kLazy>
std::unique_ptr<Planner> make_selsim() {
  const std::string name = std::string(kSelective ? "selsim" : "fullsim") + (kLazy ? "" : "-wastar");
  return make_selsim_with_retrieval({name, kSelective, kLazy});
}

template <bool kNegative, bool kPositive, bool kLearned>
std::unique_ptr<Planner> make_em4m() {
  const std::string ablation = kNegative && kPositive ? (kLearned ? "" : "-tiebreak")
                               : kNegative            ? "-negdb"
                               : kPositive            ? "-posdb"
                                                      : "-nodb";
  return make_em4m_planner({"em4m" + ablation, kNegative, kPositive, kLearned});
}

template <SamplingAlgorithm kAlgorithm>
std::unique_ptr<Planner> make_sampling() {
  return make_sampling_planner(kAlgorithm);
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {"selsim", make_selsim<true, true>, selsim_with_retrieval_options},
      {"selsim-wastar", make_selsim<true, false>, selsim_with_retrieval_options},
      {"fullsim", make_selsim<false, true>, selsim_with_retrieval_options},
      {"fullsim-wastar", make_selsim<false, false>, selsim_with_retrieval_options},
      {"em4m", make_em4m<true, true, true>, em4m_options},
      {"em4m-negdb", make_em4m<true, false, true>, em4m_options},
      {"em4m-posdb", make_em4m<false, true, true>, em4m_options},
      {"em4m-nodb", make_em4m<false, false, true>, em4m_options},
      {"em4m-tiebreak", make_em4m<true, true, false>, em4m_options},
      {"m4m", make_m4m_planner, m4m_options},
      {"dogar", make_dogar_planner, dogar_options},
      {"rrt", make_sampling<SamplingAlgorithm::rrt>, sampling_options},
      {"kpiece", make_sampling<SamplingAlgorithm::kpiece>, sampling_options},
#define MAMO_PLANNER(name, make, options) {name, make, options},
#include "planners/one_file_planners.inc"
#undef MAMO_PLANNER
  };
  return all;
}

}  // namespace

std::vector<std::string> planner_names() {
  std::vector<std::string> names;
  for (const Entry& e : entries()) names.push_back(e.name);
  return names;
}

std::unique_ptr<Planner> make_planner(const std::string& name) {
  for (const Entry& e : entries())
    if (e.name == name) return e.make();
  return nullptr;
}

std::vector<OptionDoc> planner_options(const std::string& planner) {
  for (const Entry& e : entries())
    if (e.name == planner) return e.options();
  return {};
}

}  // namespace mamo
