#include "experiments/published_em4m.hpp"

#include <map>

namespace mamo {

const PublishedEm4m* published_em4m(const std::string& planner) {
  static const std::map<std::string, PublishedEm4m> table = {
      {"em4m", {97, 45, 15}},         {"m4m", {78, 25, 7}},        {"dogar", {7, 0, 0}},
      {"selsim", {16, 8, 1}},         {"rrt", {33, 7, 1}},         {"kpiece", {16, 1, 0}},
      {"em4m-negdb", {87, 24, 7}},    {"em4m-posdb", {86, 29, 8}}, {"em4m-nodb", {82, 25, 7}},
      {"em4m-tiebreak", {85, 36, 13}}};
  const auto found = table.find(planner);
  return found == table.end() ? nullptr : &found->second;
}

}  // namespace mamo
