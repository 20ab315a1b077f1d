#include "mamo/search/parallel_options.hpp"

namespace mamo::search {

std::string_view to_string(Schedule schedule) {
  switch (schedule) {
    case Schedule::batch:
      return "batch";
    case Schedule::window:
      return "window";
    case Schedule::runahead:
      return "runahead";
  }
  return "unknown";
}

std::optional<Schedule> schedule_from(std::string_view name) {
  for (const Schedule s : {Schedule::batch, Schedule::window, Schedule::runahead}) {
    if (name == to_string(s)) return s;
  }
  return std::nullopt;
}

}  // namespace mamo::search
