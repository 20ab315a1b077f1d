// mamo train: parameters of em4m's learned priority, fitted to problems that it makes itself.
#include <thread>

#include "checks.hpp"
#include "config_file.hpp"
#include "exit_codes.hpp"
#include "interrupts.hpp"
#include "output_files.hpp"
#include "session.hpp"

#include "mamo/experiments/training.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"

namespace mamo::tool {
namespace {

struct TrainCommand {
  TrainingSpec spec;
  std::string out, config;
};

/// Options of em4m that the training is to run with; those of other planners are passed over.
Status read_options(TrainCommand& command, Console& console) {
  if (command.config.empty()) return {};
  const auto entries = read_config(command.config);
  if (!entries.ok()) return entries.error();
  const std::vector<OptionDoc> known = planner_options("em4m");
  for (const ConfigEntry& entry : *entries) {
    if (std::any_of(known.begin(), known.end(), [&](const OptionDoc& option) { return option.name == entry.key; }))
      command.spec.set[entry.key] = entry.value;
    else
      console.note(entry.place + ": '" + entry.key + "' is no option of em4m, passed over");
  }
  return {};
}

int run(TrainCommand& command, Console& console) {
  const std::string svg = command.out + ".svg";
  if (const Status status = check_outputs({command.out, svg}, {command.config}); !status.ok())
    return fail(console, status.error());
  if (const Status status = read_options(command, console); !status.ok()) return fail(console, status.error());
  StopSource stop;
  const SignalGuard signals(stop);
  const auto points = training_points(command.spec, stop, [&](int scene, int n) {
    console.progress(format("%d of %d scenes, %d rearrangements tried", scene, command.spec.scenes, n));
    console.note(format("%d of %d scenes, %d rearrangements tried", scene, command.spec.scenes, n));
  });
  console.end_progress();
  if (!points.ok()) return fail(console, points.error());
  if (stop.stopped()) {
    console.error("mamo: interrupted");
    return kNoPlan;
  }
  const Result<PriorityFit> fit = fit_priority(*points);
  if (!fit.ok()) {
    console.error("mamo: " + fit.error().message + "; --scenes and --vertices give more");
    return kNoPlan;
  }
  const std::string about = format(
      "E-M4M's learned priority, fitted by mamo train --scenes %d --vertices %d --seed %llu\nto %d rearrangements "
      "of which %d led to a plan; %d of all had nothing in the way.",
      command.spec.scenes, command.spec.vertices, static_cast<unsigned long long>(command.spec.seed), fit->points,
      fit->solved, fit->free);
  for (const auto& [file, content] :
       {std::pair(command.out, parameters_yaml(fit->parameters, about)), std::pair(svg, fit_svg(*points, *fit))})
    if (const Status status = io::write_file(file, content); !status.ok()) return fail(console, status.error());
  std::printf("%d rearrangements, %d led to a plan: %s, %s\n", fit->points, fit->solved, command.out.c_str(),
              svg.c_str());
  return kSolved;
}

}  // namespace

void add_train(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("train", "Fit em4m's learned priority to problems that it makes itself");
  auto command = std::make_shared<TrainCommand>();
  TrainingSpec& spec = command->spec;
  spec.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  sub->add_option("--out", command->out, "Parameters, for --config; FILE.svg shows the fit")
      ->type_name("FILE")
      ->required()
      ->check(file_name());
  sub->add_option("--config", command->config, "YAML file of em4m's options for the training")
      ->type_name("FILE")
      ->check(file_name());
  const auto count = [&](const char* name, auto& value, const char* meaning) {
    sub->add_option(name, value, meaning)->type_name("N")->check(whole_number(1, 1'000'000))->capture_default_str();
  };
  count("--scenes", spec.scenes, "Generated shelves");
  count("--vertices", spec.vertices, "Rearrangements of each that are tried");
  count("--collect-expansions", spec.collect_expansions, "Budget of the breadth-first run that makes them");
  count("--collect-simulations", spec.collect_simulations, "Budget of the same");
  count("--try-expansions", spec.try_expansions, "Budget of each depth-first trial");
  count("--try-simulations", spec.try_simulations, "Budget of the same");
  count("--jobs", spec.jobs, "Trials side by side; changes nothing but the time");
  sub->add_option("--seed", spec.seed, "Of every random stream")
      ->type_name("S")
      ->check(whole_number(0))
      ->capture_default_str();
  add_console_options(*sub, session);
  sub->footer(
      "Example:\n  mamo train --scenes 20 --out parameters.yaml\n  mamo plan shelf.yaml --config parameters.yaml");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
