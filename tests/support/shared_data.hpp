// Third-party data that tests read in place when it is there: $MAMO_SHARED_DATA, else ../shared/data.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace mamo::test {

inline std::string shared_data() {
  if (const char* folder = std::getenv("MAMO_SHARED_DATA")) return folder;
  return MAMO_SOURCE_DIR "/../shared/data";
}

}  // namespace mamo::test

/// Defines `name`, the path of a shared file, or skips the test saying which file is absent.
#define MAMO_SHARED_OR_SKIP(name, relative)                              \
  const std::string name = mamo::test::shared_data() + "/" + (relative); \
  if (!std::filesystem::exists(name)) GTEST_SKIP() << "not there: " << name << " (MAMO_SHARED_DATA)"
