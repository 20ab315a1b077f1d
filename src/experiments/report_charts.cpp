#include "experiments/report_charts.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "mamo/experiments/statistics.hpp"

namespace mamo {
namespace {

using Runs = std::vector<const Record*>;

/// Runs by label, and by constraints where the suite has several: one line of a chart each.
std::vector<std::pair<std::string, Runs>> lines_of(const SuiteRecords& suite) {
  std::set<std::string> constraints;
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs) constraints.insert(r->constraints);
  std::vector<std::pair<std::string, Runs>> lines;
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs) {
      const std::string name = group.label + (constraints.size() > 1 ? ", " + r->constraints : "");
      auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& l) { return l.first == name; });
      if (line == lines.end()) line = lines.insert(lines.end(), {name, {}});
      line->second.push_back(r);
    }
  return lines;
}

int varied(const SuiteRecords& suite, const std::function<int(const Record&)>& x) {
  std::set<int> values;
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs) values.insert(x(*r));
  return static_cast<int>(values.size());
}

std::string how_many(const Runs& runs) {
  std::map<std::string, int> per_setting;
  std::set<double> limits;
  for (const Record* r : runs) ++per_setting[r->setting], limits.insert(r->time_limit_s);
  int least = static_cast<int>(runs.size()), most = 0;
  for (const auto& [setting, n] : per_setting) least = std::min(least, n), most = std::max(most, n);
  char text[80];
  std::snprintf(text, sizeof text, "%d%s%s problems a setting, %g s", least, least < most ? " to " : "",
                least < most ? std::to_string(most).c_str() : "", *limits.rbegin());
  return text;
}

std::string caption_of(const std::vector<std::pair<std::string, Runs>>& lines) {
  std::string text;
  for (const auto& [name, runs] : lines) text += (text.empty() ? "" : "; ") + name + ": " + how_many(runs);
  return text + ".";
}

Chart success_chart(const SuiteRecords& suite, const std::function<int(const Record&)>& x) {
  const auto lines = lines_of(suite);
  Chart chart;
  chart.y_label = "solved (share of all)";
  chart.caption =
      "Higher is better: of all problems of a setting, the share with a plan that an independent replay "
      "confirmed. " +
      caption_of(lines);
  for (const auto& [name, runs] : lines) {
    std::map<int, Runs> at;
    for (const Record* r : runs) at[x(*r)].push_back(r);
    Series series;
    series.name = name;
    for (const auto& [value, group] : at) series.points.emplace_back(value, summarise(group).rate);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// Table I stands in the same plane as Figure 4b: 12 objects, 2 of them immovable.
void add_published(const SuiteRecords& suite, Chart& chart) {
  const auto lines = lines_of(suite);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Published* paper = published_table1(lines[i].second.front()->planner);
    const bool measured = std::any_of(lines[i].second.begin(), lines[i].second.end(), [](const Record* r) {
      return r->movable == 10 && r->immovable == 2 && r->setting.starts_with("tabletop");
    });
    if (!paper || !measured) continue;
    Series series;
    series.name = lines[i].first + ", published (Table I)";
    series.points = {{2.0, paper->success}};
    series.published = true;
    series.colour = static_cast<int>(i);
    chart.series.push_back(std::move(series));
  }
}

/// Share of the runs that were solved at or below a cost.
Series share_below(const std::string& name, const Runs& runs, const std::function<double(const Record&)>& cost,
                   double least) {
  std::vector<double> costs;
  for (const Record* r : runs)
    if (r->solved) costs.push_back(std::max(least, cost(*r)));
  std::sort(costs.begin(), costs.end());
  Series series;
  series.name = name;
  series.steps = true;
  for (std::size_t i = 0; i < costs.size(); ++i)
    series.points.emplace_back(costs[i], static_cast<double>(i + 1) / static_cast<double>(runs.size()));
  return series;
}

Chart distribution(const SuiteRecords& suite, const std::function<double(const Record&)>& cost, double least) {
  const auto lines = lines_of(suite);
  Chart chart;
  chart.log_x = true;
  chart.y_label = "solved (share of all)";
  double most = least;
  for (const auto& [name, runs] : lines) chart.series.push_back(share_below(name, runs, cost, least));
  for (const Series& series : chart.series)
    if (!series.points.empty()) most = std::max(most, series.points.back().first);
  for (Series& series : chart.series)  // a curve ends where the last problem of all was solved
    if (!series.points.empty()) series.points.emplace_back(most, series.points.back().second);
  return chart;
}

}  // namespace

std::vector<Chart> charts_of(const SuiteRecords& suite) {
  const auto objects = [](const Record& r) { return r.movable + r.immovable; };
  const auto immovable = [](const Record& r) { return r.immovable; };
  std::vector<Chart> charts;
  if (varied(suite, objects) > 1) {
    Chart chart = success_chart(suite, objects);
    chart.name = suite.name + "-objects";
    chart.title = "Success against the number of objects";
    chart.x_label = "objects (immovable ones included)";
    charts.push_back(std::move(chart));
  }
  if (varied(suite, immovable) > 1) {
    Chart chart = success_chart(suite, immovable);
    chart.name = suite.name + "-immovable";
    chart.title = "Success against the number of immovable objects";
    chart.x_label = "immovable objects";
    add_published(suite, chart);
    charts.push_back(std::move(chart));
  }
  Chart budget = distribution(
      suite, [](const Record& r) { return static_cast<double>(r.simulations); }, 1);
  budget.name = suite.name + "-budget";
  budget.title = "Success against the simulation budget";
  budget.x_label = "simulations that the search may use (--max-simulations)";
  budget.caption =
      "Further left and higher is better: at a budget, the curve is the share of all problems solved within it. A run "
      "under a budget is the beginning of the same run without one: a problem is solved within every budget from the "
      "simulations it used on. Time limits cut the curves off as everywhere. " +
      caption_of(lines_of(suite));
  charts.push_back(std::move(budget));
  Chart cactus = distribution(
      suite, [](const Record& r) { return r.time_s; }, 1e-3);
  cactus.name = suite.name + "-cactus";
  cactus.title = "Share solved within a time";
  cactus.x_label = "planning and verification (s)";
  cactus.caption =
      "Further left and higher is better: at a time, the curve is the share of all problems solved by then; "
      "where it ends, the time limit had come. " +
      caption_of(lines_of(suite));
  charts.push_back(std::move(cactus));
  return charts;
}

}  // namespace mamo
