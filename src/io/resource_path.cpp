#include "io/resource_path.hpp"

#include <cstdlib>
#include <filesystem>

namespace mamo::io {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The file itself, or the first by name in its folder that differs only in the case of its extension.
std::optional<fs::path> existing(const fs::path& path) {
  std::error_code failure;
  if (fs::is_regular_file(path, failure)) return path;
  std::optional<fs::path> found;
  for (fs::directory_iterator it(path.parent_path(), failure), end; !failure && it != end; it.increment(failure)) {
    const fs::path& other = it->path();
    if (other.stem() != path.stem() || lower(other.extension().string()) != lower(path.extension().string())) continue;
    std::error_code unreadable;
    if (fs::is_regular_file(other, unreadable) && (!found || other < *found)) found = other;
  }
  return found;
}

std::vector<std::string> search_path(const char* variable) {
  std::vector<std::string> folders;
  const char* value = std::getenv(variable);
  for (std::string rest = value ? value : ""; !rest.empty();) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) folders.push_back(rest.substr(0, colon));
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return folders;
}

bool take_prefix(std::string& text, const std::string& prefix) {
  if (lower(text.substr(0, prefix.size())) != prefix) return false;
  text.erase(0, prefix.size());
  return true;
}

/// "%20" and the like of a file:// address.
std::string percent_decoded(const std::string& text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out += code ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    if (code) i += 2;
  }
  return out;
}

std::vector<fs::path> package_candidates(const std::string& name, const std::string& rest, const fs::path& urdf_folder,
                                         const std::map<std::string, std::string>& package_path) {
  std::vector<fs::path> candidates;
  if (const auto given = package_path.find(name); given != package_path.end())
    candidates.push_back(fs::path(given->second) / rest);
  for (const std::string& folder : search_path("ROS_PACKAGE_PATH")) {
    if (fs::path(folder).filename() == name) candidates.push_back(fs::path(folder) / rest);
    candidates.push_back(fs::path(folder) / name / rest);
  }
  for (const std::string& folder : search_path("AMENT_PREFIX_PATH"))
    candidates.push_back(fs::path(folder) / "share" / name / rest);
  for (fs::path up = urdf_folder; up.has_relative_path(); up = up.parent_path())
    if (up.filename() == name) candidates.push_back(up / rest);
  candidates.push_back(urdf_folder / rest);
  candidates.push_back(urdf_folder / name / rest);
  return candidates;
}

}  // namespace

Result<std::string> resolve_resource(const std::string& uri, const std::string& urdf_path,
                                     const std::map<std::string, std::string>& package_path) {
  std::error_code failure;
  const fs::path urdf_folder = fs::absolute(urdf_path, failure).lexically_normal().parent_path();
  std::vector<fs::path> candidates;
  std::string rest = uri;
  if (take_prefix(rest, "package://") || take_prefix(rest, "model://")) {
    const std::size_t slash = rest.find('/');
    if (slash == std::string::npos || slash == 0)
      return Error{"'" + uri + "' names no file in a package, expected package://NAME/path"};
    candidates = package_candidates(rest.substr(0, slash), rest.substr(slash + 1), urdf_folder, package_path);
  } else if (take_prefix(rest, "file://")) {
    candidates.push_back(urdf_folder / percent_decoded(rest));
  } else if (uri.find("://") != std::string::npos) {
    return Error{"'" + uri + "' has an unsupported scheme, expected a path, file:// or package://"};
  } else {
    candidates.push_back(urdf_folder / uri);  // an absolute path stays as it is
  }

  std::vector<std::string> tried;
  for (const fs::path& candidate : candidates) {
    const fs::path path = candidate.lexically_normal();
    if (const std::optional<fs::path> found = existing(path)) return found->string();
    if (std::find(tried.begin(), tried.end(), path.string()) == tried.end()) tried.push_back(path.string());
  }
  std::string message = "'" + uri + "' not found; tried ";
  for (std::size_t i = 0; i < tried.size(); ++i) message += (i ? ", " : "") + tried[i];
  if (rest != uri && uri.substr(0, 4) != "file") message += " (--package-path NAME=DIR says where a package lies)";
  return Error{message};
}

}  // namespace mamo::io
