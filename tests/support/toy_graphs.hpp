// Random toy domains for property tests: every feature on and off.
#pragma once

#include <array>

#include "mamo/common/random.hpp"
#include "mamo/search/toy_domain.hpp"

namespace mamo::search {

inline RandomGraphOptions random_toy(std::uint64_t seed) {
  RandomStream random(seed, {0x746f79});
  const auto pick = [&](auto... values) {
    const std::array all{values...};
    return all[random.below(all.size())];
  };
  RandomGraphOptions o;
  o.seed = seed;
  o.nodes = pick(1, 2, 5, 20, 60, 150);
  o.degree = pick(1, 2, 3, 5, 8);
  o.max_cost = pick(1, 3, 20, 1000);
  o.goals = pick(1, 1, 1, 3);
  o.invalid = pick(0.0, 0.1, 0.3, 0.6, 1.0);
  o.labels = pick(1, 1, 2, 4);
  o.class_size = pick(1, 1, 2);
  o.heuristic = pick(0.0, 0.5, 0.9, 1.0);
  o.predict_child = pick(0, 1);
  o.layered = pick(0.0, 0.0, 5.0);
  return o;
}

inline double random_weight(std::uint64_t seed) {
  constexpr double kWeights[] = {1.0, 1.0, 1.5, 3.0, 10.0, 1.001};
  return kWeights[RandomStream(seed, {0x77}).below(6)];
}

}  // namespace mamo::search
