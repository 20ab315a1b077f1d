#include "experiments/retrieval_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "experiments/published_em4m.hpp"

#include "mamo/experiments/category_chart.hpp"
#include "mamo/experiments/statistics.hpp"

namespace mamo {
namespace {

using Runs = std::vector<const Record*>;
using ClassOf = std::string (*)(const Record&);

std::string own_class(const Record& r) { return r.difficulty.empty() ? "unknown" : r.difficulty; }
std::string listed_class(const Record& r) { return r.difficulty_listed; }

const std::vector<std::string>& class_order() {
  static const std::vector<std::string> order = {"none", "easy", "medium", "hard", "unknown"};
  return order;
}

/// Runs by class and by planner (label), planners in the order of the suite's groups.
struct Classified {
  std::vector<std::string> classes, labels;
  std::map<std::string, std::string> planner_of;  // label -> planner
  std::map<std::pair<std::string, std::string>, Runs> runs;
  const Runs& of(const std::string& difficulty, const std::string& label) const {
    static const Runs none;
    const auto found = runs.find({difficulty, label});
    return found == runs.end() ? none : found->second;
  }
};

Classified classify(const SuiteRecords& suite, ClassOf class_of) {
  Classified all;
  for (const Group& group : suite.groups) {
    if (std::find(all.labels.begin(), all.labels.end(), group.label) == all.labels.end())
      all.labels.push_back(group.label);
    for (const Record* r : group.runs) {
      const std::string difficulty = class_of(*r);
      if (difficulty.empty()) continue;
      all.planner_of[group.label] = r->planner;
      all.runs[{difficulty, group.label}].push_back(r);
    }
  }
  for (const std::string& difficulty : class_order())
    if (std::any_of(all.labels.begin(), all.labels.end(),
                    [&](const std::string& label) { return !all.of(difficulty, label).empty(); }))
      all.classes.push_back(difficulty);
  return all;
}

std::string number(const char* pattern, double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return "unsolved";
  char text[48];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string of(int part, int n) { return std::to_string(part) + "/" + std::to_string(n); }

int solved(const Runs& runs) {
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), [](const Record* r) { return r->solved; }));
}
int found(const Runs& runs) {
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), [](const Record* r) { return r->found; }));
}

double median(const Runs& runs, const std::function<double(const Record&)>& value) {
  std::vector<double> values;
  for (const Record* r : runs) values.push_back(value(*r));
  return percentile(values, 0.5);
}

/// As the paper prints it: a row for each class, a column for each planner.
Table paper_table(const SuiteRecords& suite, const Classified& all, const std::string& suffix, const std::string& by) {
  Table table;
  table.name = suite.name + "-solved" + suffix;
  table.title = suite.name + ": problems solved, by difficulty " + by;
  table.caption =
      "Solved: found, and verified by an independent replay of the whole plan; in brackets where it differs: found, "
      "which is "
      "what the paper calls solved. Beside it the paper's share (Tables 1 and 2, its own 98 easy, 63 medium and 39 "
      "hard "
      "problems, 300 s).";
  table.header = {"difficulty"};
  for (const std::string& label : all.labels) {
    table.header.push_back(label);
    if (published_em4m(all.planner_of.at(label))) table.header.push_back("paper");
  }
  for (const std::string& difficulty : all.classes) {
    std::vector<std::string> row = {difficulty};
    for (const std::string& label : all.labels) {
      const Runs& runs = all.of(difficulty, label);
      const int n = static_cast<int>(runs.size()), s = solved(runs), f = found(runs);
      row.push_back(n == 0 ? "" : of(s, n) + (f != s ? " (found " + std::to_string(f) + ")" : ""));
      if (const auto* paper = published_em4m(all.planner_of.at(label))) {
        const auto share = paper->share(difficulty);
        row.push_back(share ? number("%.2f", *share) : "");
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table full_table(const SuiteRecords& suite, const Classified& all, const std::string& suffix, const std::string& by) {
  Table table;
  table.name = suite.name + "-difficulty" + suffix;
  table.title = suite.name + ": by difficulty " + by + ", in full";
  table.caption =
      "Times in seconds, verification included; percentiles over all runs, a run that did not solve its problem "
      "took infinitely long. Pushes: in the plans found. Shares of time: medians over all runs.";
  table.header = {"difficulty",     "planner",     "found",         "solved",   "rate",
                  "95 % interval",  "25 %",        "50 %",          "75 %",     "PAR2",
                  "pushes, 50 %",   "simulations", "push attempts", "MAPF (s)", "push planning (s)",
                  "simulation (s)", "paper: rate"};
  for (const std::string& difficulty : all.classes)
    for (const std::string& label : all.labels) {
      const Runs& runs = all.of(difficulty, label);
      if (runs.empty()) continue;
      const Summary s = summarise(runs);
      const auto* paper = published_em4m(all.planner_of.at(label));
      const auto share = paper ? paper->share(difficulty) : std::nullopt;
      Runs won;
      for (const Record* r : runs)
        if (r->solved) won.push_back(r);
      table.rows.push_back(
          {difficulty, label, of(s.found, s.n), of(s.solved, s.n), number("%.3f", s.rate),
           number("%.2f", s.rate_ci[0]) + " to " + number("%.2f", s.rate_ci[1]), number("%.2f", s.percentiles[0]),
           number("%.2f", s.percentiles[1]), number("%.2f", s.percentiles[2]), number("%.2f", s.par2),
           number("%.0f", median(won, [](const Record& r) { return r.pushes; })), number("%.1f", s.simulations),
           number("%.0f", median(runs, [](const Record& r) { return static_cast<double>(r.push_attempts); })),
           number("%.3f", median(runs, [](const Record& r) { return r.mapf_s; })),
           number("%.3f", median(runs, [](const Record& r) { return r.push_planning_s; })),
           number("%.3f", median(runs, [](const Record& r) { return r.simulation_s; })),
           share ? number("%.3f", *share) : ""});
    }
  return table;
}

/// Which of two planners the paper ranks higher, and which we do.
Table order_table(const SuiteRecords& suite, const Classified& all) {
  Table table;
  table.name = suite.name + "-order";
  table.title = suite.name + ": the order of the planners, against the paper's";
  table.caption =
      "Pairs of planners that the paper has numbers of, by the share solved in a class. A pair disagrees when one "
      "is better here and the other there; equal shares agree with everything.";
  table.header = {"difficulty", "pairs", "agree", "disagree"};
  for (const std::string& difficulty : all.classes) {
    int pairs = 0, agree = 0;
    std::string others;
    for (std::size_t a = 0; a < all.labels.size(); ++a)
      for (std::size_t b = a + 1; b < all.labels.size(); ++b) {
        const Runs &one = all.of(difficulty, all.labels[a]), &two = all.of(difficulty, all.labels[b]);
        const auto* paper_one = published_em4m(all.planner_of.at(all.labels[a]));
        const auto* paper_two = published_em4m(all.planner_of.at(all.labels[b]));
        if (one.empty() || two.empty() || !paper_one || !paper_two || !paper_one->share(difficulty)) continue;
        ++pairs;
        const double ours = static_cast<double>(solved(one)) / static_cast<double>(one.size()) -
                            static_cast<double>(solved(two)) / static_cast<double>(two.size());
        const double theirs = *paper_one->share(difficulty) - *paper_two->share(difficulty);
        if (ours * theirs >= 0)
          ++agree;
        else
          others +=
              (others.empty() ? "" : "; ") + all.labels[ours > 0 ? a : b] + " above " + all.labels[ours > 0 ? b : a];
      }
    if (pairs > 0) table.rows.push_back({difficulty, std::to_string(pairs), std::to_string(agree), others});
  }
  return table;
}

bool has_retrievals(const SuiteRecords& suite, ClassOf class_of) {
  for (const Group& group : suite.groups)
    for (const Record* r : group.runs)
      if (const std::string c = class_of(*r); !c.empty() && c != "unknown") return true;
  return false;
}

Figure box_figure(const SuiteRecords& suite, const Classified& all, const std::string& name, const std::string& title,
                  const std::function<double(const Record&)>& value) {
  BoxChart chart;
  chart.name = suite.name + "-" + name;
  chart.title = title;
  chart.y_label = "seconds";
  chart.caption =
      "Box: quartiles and median over all runs, solved or not; whiskers: 5 % and 95 %. (Figure 7 of the paper.)";
  chart.categories = all.classes;
  chart.series = all.labels;
  for (const std::string& difficulty : all.classes) {
    std::vector<std::vector<double>> samples;
    for (const std::string& label : all.labels) {
      std::vector<double> sample;
      for (const Record* r : all.of(difficulty, label)) sample.push_back(value(*r));
      samples.push_back(std::move(sample));
    }
    chart.values.push_back(std::move(samples));
  }
  return {chart.name, chart.title, chart.caption, to_svg(chart)};
}

Figure stack_figure(const SuiteRecords& suite, const Classified& all) {
  StackChart chart;
  chart.name = suite.name + "-parts";
  chart.title = "Median time in path finding, push planning and simulation";
  chart.y_label = "seconds";
  chart.caption =
      "Medians over all runs, each of its own part; simulation and push planning are summed over the workers. "
      "(Figure 8 of the paper.)";
  chart.categories = all.classes;
  chart.series = all.labels;
  chart.parts = {"object path finding (MAPF)", "push planner", "simulator"};
  for (const std::string& difficulty : all.classes) {
    std::vector<std::vector<double>> stacks;
    for (const std::string& label : all.labels) {
      const Runs& runs = all.of(difficulty, label);
      if (runs.empty())
        stacks.emplace_back();
      else
        stacks.push_back({median(runs, [](const Record& r) { return r.mapf_s; }),
                          median(runs, [](const Record& r) { return r.push_planning_s; }),
                          median(runs, [](const Record& r) { return r.simulation_s; })});
    }
    chart.heights.push_back(std::move(stacks));
  }
  return {chart.name, chart.title, chart.caption, to_svg(chart)};
}

}  // namespace

std::vector<Table> retrieval_tables(const SuiteRecords& suite) {
  std::vector<Table> tables;
  if (!has_retrievals(suite, own_class)) return tables;
  const Classified own = classify(suite, own_class);
  tables.push_back(paper_table(suite, own, "", "(our own negative goal region)"));
  tables.push_back(full_table(suite, own, "", "(our own negative goal region)"));
  if (Table order = order_table(suite, own); !order.rows.empty()) tables.push_back(std::move(order));
  if (has_retrievals(suite, listed_class)) {
    const Classified listed = classify(suite, listed_class);
    tables.push_back(paper_table(suite, listed, "-listed", "(as listed)"));
    tables.push_back(full_table(suite, listed, "-listed", "(as listed)"));
  }
  return tables;
}

std::vector<Figure> retrieval_figures(const SuiteRecords& suite) {
  if (!has_retrievals(suite, own_class)) return {};
  const Classified all = classify(suite, own_class);
  return {box_figure(suite, all, "time", "Planning time", [](const Record& r) { return r.time_s; }),
          box_figure(suite, all, "simulation", "Time in the simulator", [](const Record& r) { return r.simulation_s; }),
          stack_figure(suite, all)};
}

}  // namespace mamo
