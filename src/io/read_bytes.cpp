#include "io/read_bytes.hpp"

#include <filesystem>
#include <fstream>

namespace mamo::io {

Result<std::string> read_bytes(const std::string& path, std::size_t max_bytes) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) return Error{path + ": no such file"};
  if (fs::is_directory(status)) return Error{path + ": is a folder, expected a file"};
  if (!fs::is_regular_file(status)) return Error{path + ": is not a regular file"};
  const auto size = fs::file_size(path, failure);
  if (failure) return Error{path + ": cannot be read: " + failure.message()};
  if (size > max_bytes)
    return Error{path + ": too large (" + std::to_string(size) + " bytes, at most " + std::to_string(max_bytes) + ")"};
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    return Error{path + ": cannot be read"};
  return bytes;
}

}  // namespace mamo::io
