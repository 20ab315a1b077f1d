#include "mamo/experiments/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace mamo {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double ratio(double a, double b) { return b > 0 ? a / b : kNaN; }

}  // namespace

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return kNaN;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()) - 1e-9);
  const auto k = static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(values.size())));
  return values[k - 1];
}

std::array<double, 2> wilson_interval(int successes, int n) {
  if (n == 0) return {0, 1};
  constexpr double z = 1.959963984540054;
  const double p = static_cast<double>(successes) / n;
  const double scale = 1 + z * z / n;
  const double middle = (p + z * z / (2.0 * n)) / scale;
  const double half = z / scale * std::sqrt(p * (1 - p) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Summary summarise(std::span<const Record* const> runs) {
  Summary s;
  std::vector<double> times;
  double solved_time = 0;
  for (const Record* r : runs) {
    ++s.n;
    s.found += r->found;
    s.solved += r->solved;
    s.first_goal += r->solved && r->redraws == 0;
    times.push_back(r->solved ? r->time_s : kInfinity);
    if (r->solved) solved_time += r->time_s;
    s.mean_at_limit += r->solved ? r->time_s : r->time_limit_s;
    s.par2 += r->solved ? r->time_s : 2 * r->time_limit_s;
    s.simulations += static_cast<double>(r->simulations);
    s.tracking += static_cast<double>(r->tracking);
    s.expansions += static_cast<double>(r->expansions);
    s.iterations += r->iterations;
    s.relevant += r->relevant;
  }
  s.rate = ratio(s.solved, s.n);
  s.rate_ci = wilson_interval(s.solved, s.n);
  s.mean_solved = ratio(solved_time, s.solved);
  for (double* mean :
       {&s.mean_at_limit, &s.par2, &s.simulations, &s.tracking, &s.expansions, &s.iterations, &s.relevant})
    *mean = ratio(*mean, s.n);
  for (std::size_t i = 0; i < 4; ++i) s.percentiles[i] = percentile(times, std::array{0.25, 0.5, 0.75, 0.95}[i]);
  return s;
}

Comparison compare(std::span<const Record* const> first, std::span<const Record* const> second) {
  const auto key = [](const Record* r) { return std::tuple(r->problem, r->problem_sha256, r->seed); };
  std::map<std::tuple<std::string, std::string, std::uint64_t>, const Record*> by_problem;
  for (const Record* r : second) by_problem[key(r)] = r;
  Comparison c;
  double sims[2] = {0, 0}, tracked[2] = {0, 0}, times[2] = {0, 0};
  for (const Record* a : first) {
    const auto found = by_problem.find(key(a));
    if (found == by_problem.end()) continue;
    const Record* pair[2] = {a, found->second};
    c.both += pair[0]->solved && pair[1]->solved;
    c.only_first += pair[0]->solved && !pair[1]->solved;
    c.only_second += !pair[0]->solved && pair[1]->solved;
    c.neither += !pair[0]->solved && !pair[1]->solved;
    for (int i = 0; i < 2 && pair[0]->solved && pair[1]->solved; ++i) {
      sims[i] += static_cast<double>(pair[i]->simulations);
      tracked[i] += static_cast<double>(pair[i]->simulations + pair[i]->tracking);
      times[i] += pair[i]->time_s;
    }
  }
  c.simulations = ratio(sims[1], sims[0]);
  c.with_tracking = ratio(tracked[1], tracked[0]);
  c.time = ratio(times[1], times[0]);
  return c;
}

}  // namespace mamo
