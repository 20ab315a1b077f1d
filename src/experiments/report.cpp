#include "mamo/experiments/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "experiments/report_charts.hpp"
#include "experiments/retrieval_report.hpp"

#include "mamo/experiments/statistics.hpp"

namespace mamo {
namespace {

constexpr std::size_t kSampleOfUnsolved = 12;

std::string number(const char* pattern, double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return "unsolved";
  char text[48];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string of(int part, int n) { return std::to_string(part) + "/" + std::to_string(n); }

bool table1_setting(const Record& r) {
  return r.movable == 10 && r.immovable == 2 && r.setting.starts_with("tabletop");
}

/// A published number stands only beside the setting it was measured on.
const Published* published_for(const Record& r) { return table1_setting(r) ? published_table1(r.planner) : nullptr; }

Table results_table(const SuiteRecords& suite) {
  Table table;
  table.name = suite.name + "-results";
  table.title = suite.name + ": results";
  table.caption =
      "solved: found and verified by an independent replay (found: the paper's success). Times in seconds, "
      "verification "
      "included: mean over the solved; mean with the unsolved at their limit; PAR2 (the unsolved at twice the limit); "
      "percentiles over all runs. Simulations (used by the search, and for tracking), expansions, planning iterations, "
      "relevant objects: means over all runs. first goal: solved without any redraw of goal or scene, of all.";
  table.header = {"setting",    "planner",        "found",         "solved",   "rate",       "95 % interval",
                  "first goal", "mean solved",    "mean at limit", "PAR2",     "25 %",       "50 %",
                  "75 %",       "95 %",           "simulations",   "tracking", "expansions", "iterations",
                  "relevant",   "paper: success", "paper: time"};
  for (const Group& group : suite.groups) {
    const Summary s = summarise(group.runs);
    const Published* paper = published_for(*group.runs.front());
    std::vector<std::string> row = {group.setting,
                                    group.label,
                                    of(s.found, s.n),
                                    of(s.solved, s.n),
                                    number("%.3f", s.rate),
                                    number("%.2f", s.rate_ci[0]) + " to " + number("%.2f", s.rate_ci[1]),
                                    of(s.first_goal, s.n),
                                    number("%.3f", s.mean_solved),
                                    number("%.3f", s.mean_at_limit),
                                    number("%.3f", s.par2)};
    for (double p : s.percentiles) row.push_back(number("%.3f", p));
    for (double mean : {s.simulations, s.tracking, s.expansions, s.iterations, s.relevant})
      row.push_back(number("%.1f", mean));
    row.push_back(paper ? number("%.2f", paper->success) : "");
    row.push_back(paper ? number("%g", paper->time_s) : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Every planner against the first of its setting.
Table comparison_table(const SuiteRecords& suite) {
  Table table;
  table.name = suite.name + "-comparison";
  table.title = suite.name + ": against the first planner, on the problems that both solve";
  table.caption = "Ratios are sum over sum of the second planner and the first: above 1, the first needs less.";
  table.header = {"setting",     "first",   "second",      "both",          "only first",
                  "only second", "neither", "simulations", "with tracking", "time"};
  std::map<std::string, const Group*> first_of;
  for (const Group& group : suite.groups) {
    const Group* first = first_of.emplace(group.setting, &group).first->second;
    if (first == &group) continue;
    const Comparison c = compare(first->runs, group.runs);
    table.rows.push_back({group.setting, first->label, group.label, std::to_string(c.both),
                          std::to_string(c.only_first), std::to_string(c.only_second), std::to_string(c.neither),
                          number("%.2f", c.simulations), number("%.2f", c.with_tracking), number("%.2f", c.time)});
  }
  return table;
}

/// Why runs ended without a verified plan, and a sample of them.
Table unsolved_table(const SuiteRecords& suite) {
  Table table;
  table.name = suite.name + "-unsolved";
  table.title = suite.name + ": what was not solved, and why";
  table.header = {"setting", "planner", "status", "runs", "found, not verified", "reason", "problems"};
  for (const Group& group : suite.groups) {
    std::map<std::pair<std::string, std::string>, std::vector<const Record*>> causes;
    for (const Record* r : group.runs)
      if (!r->solved) causes[{r->status, r->reason}].push_back(r);
    for (const auto& [cause, runs] : causes) {
      std::string sample;
      for (std::size_t i = 0; i < std::min(runs.size(), kSampleOfUnsolved); ++i)
        sample += (i ? ", " : "") + runs[i]->problem;
      if (runs.size() > kSampleOfUnsolved) sample += ", ...";
      const auto found = std::count_if(runs.begin(), runs.end(), [](const Record* r) { return r->found; });
      table.rows.push_back({group.setting, group.label, cause.first, std::to_string(runs.size()), std::to_string(found),
                            cause.second, sample});
    }
  }
  return table;
}

Table runs_table(const SuiteRecords& suite, const std::function<std::string(const Record&)>& page_of) {
  Table table;
  table.name = suite.name + "-runs";
  table.title = suite.name + ": every run";
  table.caption = "A problem's name leads to the playback of its plan where a page was made (mamo bench --pages).";
  table.every_run = true;
  table.header = {"problem",     "setting",    "planner",    "seed",     "status", "time (s)",
                  "simulations", "expansions", "iterations", "relevant", "reason"};
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs) {
      table.rows.push_back({r->problem, group.setting, group.label, std::to_string(r->seed), r->status,
                            number("%.3f", r->time_s), std::to_string(r->simulations), std::to_string(r->expansions),
                            std::to_string(r->iterations), std::to_string(r->relevant), r->reason});
      table.links.push_back(page_of ? page_of(*r) : "");
    }
  return table;
}

/// Each value once, in order, with how many runs had it.
template <class Get>
std::string tally(const SuiteRecords& suite, const Get& get) {
  std::map<std::string, int> values;
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs) ++values[get(*r)];
  std::string text;
  for (const auto& [value, n] : values)
    text += (text.empty() ? "" : "; ") + value + (values.size() > 1 ? " (" + std::to_string(n) + " runs)" : "");
  return text;
}

void add_facts(const SuiteRecords& suite, Report& report) {
  const std::string lead = suite.name + ": ";
  report.facts.push_back(lead + "limits: " + tally(suite, [](const Record& r) {
                           return r.label + " " +
                                  (std::isinf(r.time_limit_s) ? std::string("no time limit")
                                                              : number("%g s", r.time_limit_s));
                         }));
  report.facts.push_back(
      lead + "weight " +
      tally(suite,
            [](const Record& r) { return r.weight > 0 ? number("%g", r.weight) : std::string("the planner's own"); }) +
      "; goal tolerance " + tally(suite, [](const Record& r) {
        return number("%g m", r.position_tolerance) + number(", %g rad", r.angle_tolerance);
      }));
  report.facts.push_back(lead + "threads in a run " +
                         tally(suite, [](const Record& r) { return std::to_string(r.threads); }));
  report.facts.push_back(lead + "commit " + tally(suite, [](const Record& r) { return r.commit; }));
  report.facts.push_back(lead + "machine " + tally(suite, [](const Record& r) { return r.machine; }));
}

}  // namespace

const Published* published_table1(const std::string& planner) {
  static const std::map<std::string, Published> table = {{"selsim", {0.92, 3.23}},
                                                         {"selsim-wastar", {0.88, 5.38}},
                                                         {"fullsim", {0.40, 62.342}},
                                                         {"fullsim-wastar", {0.35, 98.26}}};
  const auto found = table.find(planner);
  return found == table.end() ? nullptr : &found->second;
}

std::vector<SuiteRecords> by_suite(const std::vector<Record>& records) {
  std::vector<const Record*> sorted;
  std::set<std::pair<std::string, std::string>> seen;
  for (const Record& r : records)
    if (seen.insert({r.run, r.settings}).second) sorted.push_back(&r);
  // The order of lines depends on --jobs; that of a report does not.
  const auto key = [](const Record* r) {
    return std::tie(r->suite, r->constraints, r->movable, r->immovable, r->setting, r->label, r->problem, r->seed,
                    r->run);
  };
  std::sort(sorted.begin(), sorted.end(), [&](const Record* a, const Record* b) { return key(a) < key(b); });
  std::vector<SuiteRecords> suites;
  for (const Record* r : sorted) {
    if (suites.empty() || suites.back().name != r->suite) suites.push_back({r->suite, {}});
    SuiteRecords& suite = suites.back();
    // Files of one glob differ in their numbers of objects and yet are one row.
    const auto group = std::find_if(suite.groups.begin(), suite.groups.end(),
                                    [&](const Group& g) { return g.setting == r->setting && g.label == r->label; });
    if (group == suite.groups.end())
      suite.groups.push_back({r->setting, r->label, {r}});
    else
      group->runs.push_back(r);
  }
  for (SuiteRecords& suite : suites) order_labels(suite);
  return suites;
}

/// Published planners in the paper's order, then by name: the first one is what the others are compared with.
void order_labels(SuiteRecords& suite) {
  const auto rank = [](const Group& g) {
    const std::vector<std::string> order = {
        "em4m",   "em4m-negdb",    "em4m-posdb", "em4m-nodb",      "em4m-tiebreak", "m4m",   "dogar",
        "selsim", "selsim-wastar", "fullsim",    "fullsim-wastar", "rrt",           "kpiece"};
    const auto found = std::find(order.begin(), order.end(), g.runs.front()->planner);
    return std::pair(found - order.begin(), g.label);
  };
  std::map<std::string, std::size_t> place;
  for (const Group& g : suite.groups) place.emplace(g.setting, place.size());
  std::stable_sort(suite.groups.begin(), suite.groups.end(), [&](const Group& a, const Group& b) {
    return std::pair(place[a.setting], rank(a)) < std::pair(place[b.setting], rank(b));
  });
}

Report make_report(std::vector<Record> records, const std::function<std::string(const Record&)>& page_of) {
  Report report;
  report.title = "Planning among movable objects: experiments";
  for (const SuiteRecords& suite : by_suite(records)) {
    add_facts(suite, report);
    for (Table& table : retrieval_tables(suite)) report.tables.push_back(std::move(table));
    for (Figure& figure : retrieval_figures(suite)) report.figures.push_back(std::move(figure));
    for (Table table :
         {results_table(suite), comparison_table(suite), unsolved_table(suite), runs_table(suite, page_of)})
      if (!table.rows.empty()) report.tables.push_back(std::move(table));
    for (Chart& chart : charts_of(suite)) report.charts.push_back(std::move(chart));
  }
  return report;
}

}  // namespace mamo
