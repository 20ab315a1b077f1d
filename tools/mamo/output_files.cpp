#include "output_files.hpp"

#include <filesystem>

#include "mamo/io/load.hpp"

namespace mamo::tool {
namespace {

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error) && !error) return true;
  return std::filesystem::weakly_canonical(a, error) == std::filesystem::weakly_canonical(b, error);
}

}  // namespace

Status check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].empty()) continue;
    for (const std::string& input : inputs)
      if (!input.empty() && same_file(outputs[i], input))
        return Error{"output " + outputs[i] + " would overwrite the input of that name", ErrorKind::usage};
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].empty() && same_file(outputs[i], outputs[k]))
        return Error{"two outputs go to " + outputs[i], ErrorKind::usage};
    if (const Status status = io::check_writable(outputs[i]); !status.ok()) return status;
  }
  return {};
}

}  // namespace mamo::tool
