#include "planning_options.hpp"

#include <algorithm>
#include <thread>

#include "checks.hpp"

#include "mamo/planners/registry.hpp"

namespace mamo::tool {
namespace {

constexpr const char* kGroup = "Planning";

std::vector<std::string> option_names(const std::string& planner) {
  std::vector<std::string> names;
  for (const OptionDoc& option : planner_options(planner)) names.push_back(option.name);
  return names;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<std::string> planners_with(const std::string& key) {
  std::vector<std::string> owners;
  for (const std::string& planner : planner_names())
    if (contains(option_names(planner), key)) owners.push_back(planner);
  return owners;
}

/// The command-line option of a key of the config file; null when there is none that a file may set.
CLI::Option* shared_option(CLI::App& command, std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  CLI::Option* option = command.get_option_no_throw("--" + key);
  return option && option->get_group() == kGroup && key != "config" && key != "set" ? option : nullptr;
}

Status apply_shared(CLI::Option& option, const ConfigEntry& entry) {
  if (option.count()) return {};  // the command line wins
  try {
    option.add_result(entry.value);
    option.run_callback();
  } catch (const CLI::ParseError& error) {
    return Error{entry.place + ": " + error.what()};
  }
  return {};
}

}  // namespace

void add_planning_options(CLI::App& command, PlanningOptions& options) {
  PlanOptions& plan = options.plan;
  plan.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.add_option("--planner", options.planner, "One of: " + join(planner_names()) + " (default: selsim to reach, em4m to retrieve)")
      ->type_name("NAME")
      ->check(one_of(planner_names()))
      ->group(kGroup);
  command.add_option("--time-limit", options.time_limit_s, "Seconds until the search gives up")
      ->type_name("SEC")
      ->check(number_above(0))
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--max-simulations", plan.max_simulations, "Give up after this many simulated motions")
      ->type_name("N")
      ->check(whole_number(0))
      ->group(kGroup);
  command.add_option("--max-expansions", plan.max_expansions, "Give up after this many expanded states")
      ->type_name("N")
      ->check(whole_number(1))
      ->group(kGroup);
  command.add_option("--memory-limit", options.memory_limit_mb, "Give up when the process holds this much")
      ->type_name("MB")
      ->check(whole_number(1))
      ->group(kGroup);
  command.add_option("--threads", plan.threads, "Results do not depend on it")
      ->type_name("N")
      ->check(whole_number(1, 4096))
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--seed", plan.seed, "Of every random stream")
      ->type_name("S")
      ->check(whole_number(0))
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--weight", plan.weight, "Suboptimality factor (default: the planner's own)")
      ->type_name("W")
      ->check(number_at_least(1))
      ->group(kGroup);
  command.add_option("--schedule", plan.schedule, "How workers compute ahead; results do not depend on it")
      ->type_name("NAME")
      ->check(one_of({"batch", "window", "runahead"}))
      ->group(kGroup);
  command.add_option("--batch", plan.batch, "Edges in one batch, or how far workers look ahead (default: the schedule's own)")
      ->type_name("K")
      ->check(whole_number(1, 1 << 20))
      ->group(kGroup);
  command.add_option("--trace", plan.trace_path, "Write the longest search of the query, job by job, for scaling")
      ->type_name("FILE")
      ->check(file_name())
      ->group(kGroup);
  command.add_flag("--explain", plan.explain, "Put what the planner tried and learned into the result, for mamo view")
      ->group(kGroup);
  command.add_flag("--no-smooth", options.no_smooth, "Keep the raw path of the search")->group(kGroup);
  command.add_option("--config", options.config, "YAML file of options by name; the command line wins over it")
      ->type_name("FILE")
      ->check(file_name())
      ->group(kGroup);
  command.add_option("--set", options.settings, "One option of the planner; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check(assignment("KEY=VALUE"))
      ->group(kGroup);
}

Status complete(CLI::App& command, PlanningOptions& options, Console& console) {
  if (!options.config.empty()) {
    const auto entries = read_config(options.config);
    if (!entries.ok()) return entries.error();
    for (const ConfigEntry& entry : *entries) {
      CLI::Option* option = shared_option(command, entry.key);
      if (!option) {
        options.unshared.push_back(entry);
      } else if (const Status status = apply_shared(*option, entry); !status.ok()) {
        return status;
      }
    }
  }
  options.plan.smooth = !options.no_smooth;
  return options.planner.empty() ? Status{} : settle_planner(command, options, options.planner, console);
}

Status settle_planner(CLI::App& command, PlanningOptions& options, const std::string& planner, Console& console) {
  options.planner = planner;
  const std::vector<std::string> known = option_names(options.planner);
  for (const ConfigEntry& entry : options.unshared) {
    if (contains(known, entry.key)) {
      options.plan.set[entry.key] = entry.value;
    } else if (!planners_with(entry.key).empty()) {
      console.note(entry.place + ": '" + entry.key + "' is no option of " + options.planner + ", passed over");
    } else {
      std::vector<std::string> nearby = known;
      for (const CLI::Option* option : command.get_options())
        if (option->get_group() == kGroup) nearby.push_back(option->get_lnames().front());
      return Error{entry.place + ": unknown option '" + entry.key + "'" + did_you_mean(entry.key, nearby)};
    }
  }
  for (const std::string& setting : options.settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (!contains(known, key)) {
      const std::vector<std::string> owners = planners_with(key);
      const std::string hint = owners.empty() ? did_you_mean(key, known) : " (it is one of " + join(owners) + ")";
      return Error{"--set: planner " + options.planner + " has no option '" + key + "'" + hint, ErrorKind::usage};
    }
    options.plan.set[key] = setting.substr(key.size() + 1);
  }
  return {};
}

std::string describe_planner_options() {
  struct Row {
    OptionDoc doc;
    std::vector<std::string> planners;
  };
  std::vector<Row> rows;  // options that several planners share with one default and meaning stand once
  for (const std::string& planner : planner_names())
    for (const OptionDoc& doc : planner_options(planner)) {
      const auto same = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
        return row.doc.name == doc.name && row.doc.default_value == doc.default_value && row.doc.meaning == doc.meaning;
      });
      if (same == rows.end())
        rows.push_back({doc, {planner}});
      else
        same->planners.push_back(planner);
    }
  std::string text;
  for (const Row& row : rows) {
    text +=
        format("  %-26s %s (default %s", row.doc.name.c_str(), row.doc.meaning.c_str(), row.doc.default_value.c_str());
    text += row.planners.size() == planner_names().size() ? ")\n" : "; " + join(row.planners) + ")\n";
  }
  return text.empty() ? "" : "Options of the planners, for --set and --config:\n" + text;
}

}  // namespace mamo::tool
