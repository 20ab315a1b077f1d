#include "mamo/search/virtual_time.hpp"

namespace mamo::search {

double clairvoyant_s(const WorkAndSpan& work, int workers) {
  const std::size_t n = work.commits.size();
  std::vector<std::vector<std::int32_t>> children(n);
  using Index = std::priority_queue<std::int32_t, std::vector<std::int32_t>, std::greater<>>;
  Index ready;  // earliest commit first
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t parent = work.commits[i].parent;
    if (parent < 0) {
      ready.push(static_cast<std::int32_t>(i));
    } else {
      children[static_cast<std::size_t>(parent)].push_back(static_cast<std::int32_t>(i));
    }
  }
  using Event = std::pair<double, std::int32_t>;  // end, commit
  std::priority_queue<Event, std::vector<Event>, std::greater<>> running;
  double clock = 0;
  while (!ready.empty() || !running.empty()) {
    while (!ready.empty() && running.size() < static_cast<std::size_t>(workers)) {
      running.push({clock + work.commits[static_cast<std::size_t>(ready.top())].seconds, ready.top()});
      ready.pop();
    }
    const auto [end, commit] = running.top();
    running.pop();
    clock = end;
    for (const std::int32_t child : children[static_cast<std::size_t>(commit)]) ready.push(child);
  }
  return clock;
}

}  // namespace mamo::search
