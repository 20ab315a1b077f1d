#include "session.hpp"

namespace mamo::tool {

void add_console_options(CLI::App& command, Session& session) {
  const char* group = "Messages";
  Console& console = session.console;
  command.add_flag("--quiet", console.quiet, "No progress, no warnings")->group(group);
  command.add_flag("-v,--verbose", console.verbosity, "More messages")->group(group);
  command.add_flag("--no-color", console.no_color, "No colours; the variable NO_COLOR does the same")->group(group);
}

}  // namespace mamo::tool
