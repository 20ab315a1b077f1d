#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mamo/experiments/record.hpp"
#include "mamo/io/load.hpp"

namespace mamo {
namespace {

Error failed(const std::string& path, const std::string& what) {
  return {path + ": " + what + ": " + std::strerror(errno), ErrorKind::output};
}

}  // namespace

RecordFile::~RecordFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Status RecordFile::open(const std::string& path, bool resume) {
  path_ = path;
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return failed(path, "cannot be written");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
    return Error{path + ": another mamo bench is writing it", ErrorKind::output};
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  if (size == 0) return {};
  if (!resume)
    return Error{path + " holds results already; --resume goes on with them, --out names another file",
                 ErrorKind::usage};
  const auto text = io::read_file(path, std::size_t{4} << 30);
  if (!text.ok()) return text.error();
  const auto records = read_records(path);
  if (!records.ok()) return records.error();
  for (const Record& record : *records) {
    done_.insert({record.run, record.settings});
    ids_.insert(record.run);
    commits_.insert(record.commit);
  }
  const std::size_t whole = text->rfind('\n') == std::string::npos ? 0 : text->rfind('\n') + 1;
  if (whole < text->size() && ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
    return failed(path, "its torn last line cannot be cut off");
  return {};
}

Result<bool> RecordFile::done(const BenchRun& run) const {
  if (done_.contains({run.id, run.settings})) return true;
  if (ids_.contains(run.id))
    return Error{path_ + " holds the run '" + run.id + "' with other options or limits: the suite has changed; --out " +
                     "names another file",
                 ErrorKind::usage};
  return false;
}

Status RecordFile::append(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = write(descriptor_, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return failed(path_, "cannot be written");
    written += static_cast<std::size_t>(n);
  }
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) return failed(path_, "cannot be flushed");
  return {};
}

}  // namespace mamo
