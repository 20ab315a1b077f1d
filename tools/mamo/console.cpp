#include "console.hpp"

#include <unistd.h>

#include <cstdarg>
#include <cstdlib>

#include "exit_codes.hpp"

namespace mamo::tool {
namespace {

bool wants_colour(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return isatty(descriptor) && !(no_color && *no_color) && !(term && std::string_view(term) == "dumb");
}

}  // namespace

void Console::line(std::string_view text) {
  end_progress();
  const std::string safe = one_line(text) + "\n";
  std::fwrite(safe.data(), 1, safe.size(), stderr);
}

void Console::error(std::string_view text) { line(text); }
void Console::warn(std::string_view text) {
  if (!quiet) line("warning: " + std::string(text));
}
void Console::note(std::string_view text) {
  if (!quiet && verbosity > 0) line(text);
}
void Console::warn_all(const std::vector<std::string>& lines) {
  for (const std::string& text : lines) warn(text);
}

bool Console::shows_progress() const { return !quiet && isatty(STDERR_FILENO); }

void Console::progress(std::string_view text) {
  if (!shows_progress()) return;
  std::fprintf(stderr, "\r\033[K%s", one_line(text).c_str());
  std::fflush(stderr);
  progress_shown_ = true;
}

void Console::end_progress() {
  if (progress_shown_) std::fputs("\r\033[K", stderr);
  progress_shown_ = false;
}

std::string Console::coloured(std::string_view text, bool good) const {
  if (no_color || !wants_colour(STDOUT_FILENO)) return std::string(text);
  return (good ? "\033[1;32m" : "\033[1;31m") + std::string(text) + "\033[0m";
}

int fail(Console& console, const Error& error) {
  // Bad input begins with its own place (file:line:column), which editors jump to.
  const bool place_first = error.kind == ErrorKind::invalid_input;
  std::string text = (place_first ? "" : "mamo: ") + error.message;
  if (error.kind == ErrorKind::internal)
    text += " (this is a bug of mamo " MAMO_VERSION ": please report the command, the problem file and this line)";
  console.error(text);
  return exit_code(error.kind);
}

std::string one_line(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '\n')
      out += out.empty() || out.back() == ' ' ? "" : "; ";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += c == '\t' ? ' ' : '?';
    else
      out += c;
  }
  while (out.ends_with("; ") || out.ends_with(' ')) out.pop_back();
  if (out.ends_with(';')) out.pop_back();
  return out;
}

std::string format(const char* pattern, ...) {
  std::va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

}  // namespace mamo::tool
