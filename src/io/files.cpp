// Whole files in and out, and where relative paths are looked up.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "io/text.hpp"
#include "mamo/io/load.hpp"

namespace mamo::io {
namespace fs = std::filesystem;
namespace {

/// Closes on every way out.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

Error cannot(const std::string& path, const std::string& what, ErrorKind kind) {
  return {one_line(path) + ": " + what + ": " + std::strerror(errno), kind};
}

Error too_large(const std::string& path, std::size_t max_bytes) {
  return {one_line(path) + ": is too large (more than " + std::to_string(max_bytes) + " bytes)",
          ErrorKind::invalid_input};
}

/// A file beside `path` that did not exist before, opened for writing; name in `temporary`.
int open_temporary(const std::string& path, std::string& temporary) {
  for (int i = 0; i < 100; ++i) {
    temporary = path + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(i);
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0 || errno != EEXIST) return fd;
  }
  return -1;
}

bool write_all(int fd, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = ::write(fd, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

/// Pipes and devices (/dev/stdout) are written in place: there is nothing to replace.
bool is_special(const std::string& path) {
  struct stat info{};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/// The file behind a symbolic link, so that replacing it keeps the link.
std::string behind_links(const std::string& path) {
  std::error_code failure;
  if (!fs::is_symlink(path, failure)) return path;
  const fs::path target = fs::canonical(path, failure);
  return failure ? path : target.string();
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
  if (path.empty()) return Error{"no file name given"};
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0) return cannot(path, "cannot be read", ErrorKind::invalid_input);
  struct stat info{};
  if (::fstat(file.fd, &info) != 0) return cannot(path, "cannot be read", ErrorKind::invalid_input);
  if (S_ISDIR(info.st_mode)) return Error{one_line(path) + ": is a folder, a file was expected"};
  const std::size_t size = S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) : 0;
  if (size > max_bytes) return too_large(path, max_bytes);
  std::string text;
  text.reserve(size + 1);
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(file.fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return cannot(path, "cannot be read", ErrorKind::invalid_input);
    if (n == 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
    if (text.size() > max_bytes) return too_large(path, max_bytes);
  }
}

Status check_writable(const std::string& path) {
  const Error no_name{"no output file name given", ErrorKind::output};
  if (path.empty()) return no_name;
  std::error_code failure;
  if (fs::is_directory(path, failure))
    return Error{one_line(path) + ": is a folder, cannot be written as a file", ErrorKind::output};
  if (fs::exists(path, failure) && ::access(path.c_str(), W_OK) != 0)
    return cannot(path, "cannot be written", ErrorKind::output);
  if (is_special(path)) return {};
  std::string temporary;
  const Descriptor file{open_temporary(behind_links(path), temporary)};
  if (file.fd < 0) return cannot(path, "cannot be written", ErrorKind::output);
  ::unlink(temporary.c_str());
  return {};
}

Status write_file(const std::string& path, const std::string& content) {
  if (Status writable = check_writable(path); !writable) return writable;
  if (is_special(path)) {
    const Descriptor file{::open(path.c_str(), O_WRONLY | O_CLOEXEC)};
    if (file.fd < 0 || !write_all(file.fd, content)) return cannot(path, "cannot be written", ErrorKind::output);
    return {};
  }
  const std::string target = behind_links(path);
  std::string temporary;
  bool written = false;
  {
    const Descriptor file{open_temporary(target, temporary)};
    if (file.fd < 0) return cannot(path, "cannot be written", ErrorKind::output);
    written = write_all(file.fd, content);
  }
  if (written && std::rename(temporary.c_str(), target.c_str()) == 0) return {};
  const Error error = cannot(path, "cannot be written", ErrorKind::output);
  ::unlink(temporary.c_str());
  return error;
}

Result<std::string> find_data_file(const std::string& relative, const std::string& beside_file) {
  std::error_code failure;
  if (relative.empty()) return Error{"a file name is empty"};
  if (fs::path(relative).is_absolute()) {
    if (fs::exists(relative, failure)) return relative;
    return Error{one_line(relative) + ": no such file"};
  }
  std::vector<fs::path> folders;
  if (!beside_file.empty()) folders.push_back(fs::path(beside_file).parent_path());
  if (const char* data = std::getenv("MAMO_DATA_DIR"); data && *data) folders.emplace_back(data);
  folders.emplace_back(MAMO_SOURCE_DATA_DIR);
  folders.emplace_back(MAMO_INSTALL_DATA_DIR);
  std::string tried;
  for (const fs::path& folder : folders) {
    const fs::path candidate = folder / relative;
    if (fs::exists(candidate, failure)) return candidate.string();
    tried += (tried.empty() ? "" : ", ") + candidate.string();
  }
  return Error{one_line(relative) + ": no such file (tried " + one_line(tried) + ")"};
}

}  // namespace mamo::io
