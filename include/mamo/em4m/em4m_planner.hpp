// Enhanced-M4M (Saxena, Likhachev 2023) behind `Planner`: retrieval by rearranging what stands in the way.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

/// The algorithm and its ablations (ALGORITHMS.md, "Ablations").
struct Em4mVariant {
  std::string name;
  bool negative_cache = true;    // goals near those that failed cost more; off: only exact failures are excluded
  bool positive_cache = true;    // successful pushes are used again where nothing that mattered has changed
  bool learned_priority = true;  // off: lexicographic
};

std::unique_ptr<Planner> make_em4m_planner(const Em4mVariant& variant);
std::vector<OptionDoc> em4m_options();

}  // namespace mamo
