// Enhanced-M4M (Saxena, Likhachev 2023) behind `Planner`: retrieval by rearranging what stands in the way.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mamo/em4m/priority.hpp"
#include "mamo/model/option_table.hpp"
#include "mamo/model/planner.hpp"

namespace mamo {

/// Which rearrangement is expanded next. An expansion in vain counts as a level of the two orders by depth.
enum class Em4mOrder { promising, breadth_first, depth_first };

/// The algorithm and its ablations (ALGORITHMS.md, "Ablations").
struct Em4mVariant {
  std::string name;
  bool negative_cache = true;    // goals near those that failed cost more; off: only exact failures are excluded
  bool positive_cache = true;    // successful pushes are used again where nothing that mattered has changed
  bool learned_priority = true;  // off: lexicographic

  // For training ("Learned Priority Function").
  Em4mOrder order = Em4mOrder::promising;
  bool retrieves = true;  // off: rearranges until a limit stops it, and solves nothing
  std::function<void(const WorldState&, const RegionFeatures&)> on_vertex = {};  // for every rearrangement as it is made
};

std::unique_ptr<Planner> make_em4m_planner(const Em4mVariant& variant);
std::vector<OptionDoc> em4m_options();

}  // namespace mamo
