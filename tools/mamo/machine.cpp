#include "machine.hpp"

#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "source_commit.hpp"  // written by every build

namespace mamo::tool {
namespace {

/// The value after the first line's "key", e.g. of /proc/cpuinfo or /etc/os-release; "unknown" when there is none.
std::string value_in(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(line.find_first_of(":=", key.size()) + 1);
    std::erase(value, '"');
    return value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
  }
  return "unknown";
}

}  // namespace

std::string machine_json() {
  utsname system{};
  uname(&system);
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  nlohmann::ordered_json json;
  json["processor"] = value_in("/proc/cpuinfo", "model name");
  json["cores"] = std::thread::hardware_concurrency();
  json["memory_gb"] = std::round(bytes / 1e8) / 10;
  json["system"] =
      value_in("/etc/os-release", "PRETTY_NAME") + ", " + system.sysname + " " + system.release + " " + system.machine;
  json["compiler"] = MAMO_COMPILER;
  json["build"] = MAMO_BUILD_TYPE;
  json["libraries"] = MAMO_LIBRARIES;
  return json.dump();
}

std::string source_commit() { return MAMO_SOURCE_COMMIT; }

}  // namespace mamo::tool
