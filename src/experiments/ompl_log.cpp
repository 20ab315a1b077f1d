#include "mamo/experiments/ompl_log.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "experiments/report_charts.hpp"

namespace mamo {
namespace {

constexpr const char* kStatuses[] = {"solved", "limit",  "timeout", "interrupted",
                                     "memory", "proven", "invalid", "error"};

std::string number(double value) {
  if (!std::isfinite(value)) return "";  // nothing between two separators: no value
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The log is read line by line and cell by cell.
std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == ';' || c == '|') c = ' ';
  return text;
}

int status_index(const std::string& status) {
  int index = 0;
  for (const char* s : kStatuses) {
    if (status == s) return index;
    ++index;
  }
  return index - 1;
}

struct Property {
  const char* name;  // with its type
  std::string (*value)(const Record&);
};
const Property kProperties[] = {
    {"time REAL", [](const Record& r) { return number(r.time_s); }},
    {"solved BOOLEAN", [](const Record& r) { return std::string(r.solved ? "1" : "0"); }},
    {"status ENUM", [](const Record& r) { return std::to_string(status_index(r.status)); }},
    {"found BOOLEAN", [](const Record& r) { return std::string(r.found ? "1" : "0"); }},
    {"time to first plan REAL", [](const Record& r) { return r.found ? number(r.found_s) : ""; }},
    {"simulations INTEGER", [](const Record& r) { return std::to_string(r.simulations); }},
    {"expansions INTEGER", [](const Record& r) { return std::to_string(r.expansions); }},
    {"push attempts INTEGER", [](const Record& r) { return std::to_string(r.push_attempts); }},
    {"pushes INTEGER", [](const Record& r) { return r.solved ? std::to_string(r.pushes) : ""; }},
    {"object path finding time REAL", [](const Record& r) { return number(r.mapf_s); }},
    {"push planning time REAL", [](const Record& r) { return number(r.push_planning_s); }},
    {"simulation time REAL", [](const Record& r) { return number(r.simulation_s); }},
    {"seed INTEGER", [](const Record& r) { return std::to_string(r.seed); }},
};

using Planners = std::vector<const Group*>;

std::string header(const std::string& name, const Planners& planners) {
  const Record& first = *planners.front()->runs.front();
  double limit = 0, spent = 0;
  std::size_t most = 0;
  std::string started = first.started;
  for (const Group* planner : planners) {
    most = std::max(most, planner->runs.size());
    for (const Record* r : planner->runs) {
      if (std::isfinite(r->time_limit_s)) limit = std::max(limit, r->time_limit_s);
      spent += r->time_s;
      started = std::min(started, r->started);
    }
  }
  std::replace(started.begin(), started.end(), 'T', ' ');
  if (started.ends_with('Z')) started.pop_back();
  std::string text = "mamo version " + first.version + "\nExperiment " + name + "\n3 experiment properties\n" +
                     "num_movable INTEGER = " + std::to_string(first.movable) + "\n" +
                     "num_immovable INTEGER = " + std::to_string(first.immovable) + "\n" +
                     "num_threads INTEGER = " + std::to_string(first.threads) + "\n" + "Running on " +
                     one_line(first.processor) + "\nStarting at " + started + "\n<<<|\n" +
                     one_line("commit " + first.commit + ", constraints " + first.constraints) + "\n|>>>\n<<<|\n" +
                     one_line(first.machine) + "\n|>>>\n";
  text += std::to_string(first.seed) + " is the random seed\n" + number(limit) + " seconds per run\n0 MB per run\n" +
          std::to_string(most) + " runs per planner\n" + number(spent) +
          " seconds spent to collect the data\n1 enum type\nstatus";
  for (const char* s : kStatuses) text += std::string("|") + s;
  return text + "\n" + std::to_string(planners.size()) + " planners\n";
}

std::string planner_text(const Group& planner, const std::map<std::string, int>& numbers) {
  const Record& first = *planner.runs.front();
  std::string text = one_line(planner.label) + "\n2 common properties\nname = " + first.planner +
                     "\nweight = " + number(first.weight) + "\n" + std::to_string(std::size(kProperties) + 1) +
                     " properties for each run\n";
  for (const Property& p : kProperties) text += std::string(p.name) + "\n";
  text += "problem INTEGER\n" + std::to_string(planner.runs.size()) + " runs\n";
  for (const Record* r : planner.runs) {
    for (const Property& p : kProperties) text += p.value(*r) + "; ";
    text += std::to_string(numbers.at(r->problem)) + "; \n";
  }
  return text + ".\n";
}

/// One word: the reader takes an experiment's last one.
std::string word(const std::string& name) {
  std::string text;
  for (char c : name) text += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '+' ? c : '_';
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> ompl_logs(const std::vector<Record>& records) {
  std::vector<std::pair<std::string, std::string>> logs;
  for (const SuiteRecords& suite : by_suite(records)) {
    std::vector<std::pair<std::string, Planners>> settings;
    for (const Group& group : suite.groups) {
      if (settings.empty() || settings.back().first != group.setting) settings.push_back({group.setting, {}});
      settings.back().second.push_back(&group);
    }
    for (const auto& [setting, planners] : settings) {
      std::set<std::string> problems;
      for (const Group* planner : planners)
        for (const Record* r : planner->runs) problems.insert(r->problem);
      std::map<std::string, int> numbers;
      for (const std::string& problem : problems) numbers.emplace(problem, static_cast<int>(numbers.size()));
      const std::string name = word(suite.name + " " + setting);
      std::string text = header(name, planners);
      for (const Group* planner : planners) text += planner_text(*planner, numbers);
      logs.emplace_back(name + ".log", std::move(text));
    }
  }
  return logs;
}

}  // namespace mamo
