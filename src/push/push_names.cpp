#include "mamo/push/push_planner.hpp"

namespace mamo {

std::string_view to_string(PushFailure failure) {
  switch (failure) {
    case PushFailure::none:
      return "none";
    case PushFailure::start_in_obstacle:
      return "start_in_obstacle";
    case PushFailure::start_unreachable:
      return "start_unreachable";
    case PushFailure::start_in_collision:
      return "start_in_collision";
    case PushFailure::no_approach:
      return "no_approach";
    case PushFailure::path_unreachable:
      return "path_unreachable";
    case PushFailure::joint_limit:
      return "joint_limit";
    case PushFailure::path_in_collision:
      return "path_in_collision";
    case PushFailure::misses_object:
      return "misses_object";
    case PushFailure::violation:
      return "violation";
    case PushFailure::nothing_moved:
      return "nothing_moved";
    case PushFailure::no_retreat:
      return "no_retreat";
    case PushFailure::stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace mamo
