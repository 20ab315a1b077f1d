// What a measurement was made on and by: for the "machine" of a bench line.
#pragma once

#include <string>

namespace mamo::tool {

/// JSON object: processor, cores, memory, system, compiler, build, libraries. No name of the machine.
std::string machine_json();
/// Of the sources that this program was built from, "-dirty" when they were changed since; "unknown" without git.
std::string source_commit();

}  // namespace mamo::tool
