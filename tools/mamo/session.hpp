// One run of the tool: parsing fills it, main runs what was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "console.hpp"

namespace mamo::tool {

struct Session {
  Console console;
  std::function<int()> run;  // set by the subcommand that was parsed; returns the exit code
};

/// Each adds one subcommand to the application. Their options live in the callbacks they register.
void add_plan(CLI::App& app, Session& session);
void add_verify(CLI::App& app, Session& session);
void add_generate(CLI::App& app, Session& session);
void add_info(CLI::App& app, Session& session);
void add_convert(CLI::App& app, Session& session);
void add_bench(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_train(CLI::App& app, Session& session);
void add_view(CLI::App& app, Session& session);

/// --quiet, -v, --no-color; every subcommand has them.
void add_console_options(CLI::App& command, Session& session);

}  // namespace mamo::tool
