#include "generated_files.hpp"

#include <algorithm>
#include <filesystem>

#include "checks.hpp"

#include "mamo/io/load.hpp"

namespace mamo::tool {
namespace {

/// Makes the folder if need be. An error of kind output when no file can be put there.
Status prepare_folder(const std::string& folder, const std::string& first_file) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    return Error{folder + ": cannot be made a folder (" + (error ? error.message() : "it is a file") + ")",
                 ErrorKind::output};
  return io::check_writable(first_file);
}

/// YAML files in the folder that this run has not written: they would be taken for its own.
int strangers(const std::string& folder, const std::vector<std::string>& written) {
  int found = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".yaml" &&
        std::find(written.begin(), written.end(), entry.path().filename()) == written.end())
      ++found;
  return found;
}

}  // namespace

Result<std::vector<Problem>> write_problems(const std::string& folder, int count,
                                            const std::function<Result<Problem>(int)>& make, StopSource& stop,
                                            Console& console) {
  std::vector<Problem> problems;
  std::vector<std::string> names;
  for (int i = 0; i < count && !stop.stopped(); ++i) {
    Result<Problem> problem = make(i);
    if (!problem.ok()) return problem.error();
    const std::string file = (std::filesystem::path(folder) / problem->name).string();
    if (i == 0)
      if (const Status status = prepare_folder(folder, file); !status.ok()) return status.error();
    const Result<std::string> text = io::to_native_yaml(*problem);
    if (!text.ok()) return text.error();
    if (const Status status = io::write_file(file, *text); !status.ok()) return status.error();
    console.progress(format("%d of %d problems", i + 1, count));
    names.push_back(problem->name);
    problems.push_back(std::move(*problem));
  }
  console.end_progress();
  if (const int others = strangers(folder, names); others > 0)
    console.warn(format("%s holds %d other .yaml files, left as they are", folder.c_str(), others));
  std::printf("%zu problems in %s\n", problems.size(), folder.c_str());
  std::fflush(stdout);
  return problems;
}

}  // namespace mamo::tool
