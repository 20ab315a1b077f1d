#include "io/recognise.hpp"

#include <string_view>

#include "io/text.hpp"

namespace mamo::io {
namespace {

/// The first lines without leading blank space, as far as a format shows itself.
std::string_view head_of(const std::string& text) {
  std::string_view head(text);
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  head.remove_prefix(first == std::string_view::npos ? head.size() : first);
  return head.substr(0, 2000);
}

bool has_line_starting(std::string_view text, std::string_view word) {
  return text.starts_with(word) || text.find("\n" + std::string(word)) != std::string_view::npos;
}

}  // namespace

Status check_is_text(const std::string& text, const std::string& path) {
  if (head_of(text).empty()) return Error{one_line(path) + ": the file is empty"};
  std::size_t line = 1, controls = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (c == '\n') ++line;
    if (c == 0) return Error{one_line(path) + ": is a binary file (a zero byte at offset " + std::to_string(i) + "), text was expected"};
    if (c < 0x20 && c != '\n' && c != '\t' && c != '\r' && c != '\f' && ++controls > 8)
      return Error{one_line(path) + ":" + std::to_string(line) + ": is a binary file (control characters), text was expected"};
  }
  return {};
}

Status refuse_foreign(const std::string& text, const std::string& path) {
  const std::string_view head = head_of(text);
  const auto refuse = [&](const std::string& what) { return Error{one_line(path) + ": " + what}; };
  if (head.starts_with("<")) {
    if (head.find("<robot") != std::string_view::npos)
      return refuse("looks like a robot description (URDF or SRDF), a problem was expected (give the robot with --robot)");
    if (head.find("<sdf") != std::string_view::npos)
      return refuse("looks like an SDFormat world, which is not supported as a problem");
    return refuse("looks like XML, a problem was expected");
  }
  if (head.starts_with("{") && head.find("\"mamo-result/") != std::string_view::npos)
    return refuse("looks like a result of mamo, a problem was expected");
  if (head.starts_with("{") && head.find("\"segments\"") != std::string_view::npos)
    return refuse("looks like a plan of mamo, a problem was expected");
  if (has_line_starting(head, "* ") && has_line_starting(text, "."))
    return refuse("looks like a MoveIt scene text (.scene), which is not supported");
  return {};
}

}  // namespace mamo::io
