#include "mamo/search/search_result.hpp"

namespace mamo::search {

std::string_view to_string(EndReason reason) {
  switch (reason) {
    case EndReason::goal:
      return "goal";
    case EndReason::exhausted:
      return "exhausted";
    case EndReason::limit_expansions:
      return "limit_expansions";
    case EndReason::limit_evaluations:
      return "limit_evaluations";
    case EndReason::limit_charge:
      return "limit_charge";
    case EndReason::stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace mamo::search
