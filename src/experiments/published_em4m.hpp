// Tables 1 and 2 of Saxena and Likhachev (Enhanced-M4M, 2023).
#pragma once

#include <optional>
#include <string>

namespace mamo {

struct PublishedEm4m {
  int easy, medium, hard;  // problems solved
  /// Of the paper's problems of a class; nothing for classes that it does not have.
  std::optional<double> share(const std::string& difficulty) const {
    if (difficulty == "easy") return easy / 98.0;
    if (difficulty == "medium") return medium / 63.0;
    if (difficulty == "hard") return hard / 39.0;
    return std::nullopt;
  }
};
/// Null for planners that the paper does not have.
const PublishedEm4m* published_em4m(const std::string& planner);

}  // namespace mamo
