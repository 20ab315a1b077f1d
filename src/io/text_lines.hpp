// Line-oriented text: lines with their numbers, fields between commas.
#pragma once

#include <string_view>
#include <vector>

namespace mamo::io {

/// Without blanks, tabs and carriage returns at the ends.
std::string_view trimmed(std::string_view text);

/// The fields between commas, each trimmed.
std::vector<std::string_view> comma_fields(std::string_view line);

/// Hands out the lines of a text one by one, trimmed, without the blank ones, and knows their number. The text
/// must outlive it.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}
  /// False at the end of the text.
  bool next(std::string_view& line);
  /// 1-based, of the line handed out last.
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace mamo::io
