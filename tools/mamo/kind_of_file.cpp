#include "kind_of_file.hpp"

#include "mamo/io/load.hpp"

namespace mamo::tool {

Result<FileKind> kind_of_file(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text.ok()) return text.error();
  const std::size_t first = text->find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (first == std::string::npos) return Error{path + ": the file is empty; expected a robot, a problem or a plan"};
  if ((*text)[first] == '<') return FileKind::robot;
  // A problem may be YAML in braces: a plan is told by its keys, which stand even in a truncated file.
  const bool has_plan_keys =
      text->find("\"segments\"") != std::string::npos || text->find("\"mamo-result") != std::string::npos;
  return (*text)[first] == '{' && has_plan_keys ? FileKind::plan : FileKind::problem;
}

}  // namespace mamo::tool
