#include "io/text.hpp"

#include <charconv>
#include <cstdio>
#include <limits>
#include <system_error>

namespace mamo::io {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

std::string shortest_number(double value) {
  if (value != value) return "nan";
  if (value == std::numeric_limits<double>::infinity()) return "inf";
  if (value == -std::numeric_limits<double>::infinity()) return "-inf";
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, end);
}

std::string yaml_number(double value) {
  std::string text = shortest_number(value);
  if (text == "nan" || text == "inf") return "." + text;
  if (text == "-inf") return "-.inf";
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  return exponent == std::string::npos ? text + ".0" : text.insert(exponent, ".0");
}

std::string yaml_string(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '/' || (c >= '0' && c <= '9') ||
           c == '.' || c == '-' || c == '+';
  };
  bool safe = !text.empty() && std::all_of(text.begin(), text.end(), plain) && !parse_number(text);
  for (std::string_view word : {"true", "false", "null", "yes", "no", "on", "off", "y", "n"})
    safe = safe && lower_case(text) != word;
  if (safe && text.front() != '-' && text.front() != '.' && text.front() != '+') return std::string(text);
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (is_control(c)) {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned char>(c));
      out += code;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string one_line(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (!is_control(c)) {
      out += c;
    } else if (c == '\n' || c == '\t') {
      out += ' ';
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned char>(c));
      out += code;
    }
  }
  return out;
}

std::string in_quotes(std::string_view text) {
  const bool cut = text.size() > 60;
  return "'" + one_line(text.substr(0, 60)) + (cut ? "...'" : "'");
}

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  bool negative = false;
  std::string_view rest = text;
  if (!rest.empty() && rest.front() == '-') negative = true, rest.remove_prefix(1);
  if (rest == ".inf" || rest == ".Inf" || rest == ".INF")
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  if (rest == ".nan" || rest == ".NaN" || rest == ".NAN") return std::numeric_limits<double>::quiet_NaN();
  if (rest.empty() || rest.front() == '-' || rest.front() == '+') return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {  // too large or too small for a double
    const bool small = rest.find("e-") != std::string_view::npos || rest.find("E-") != std::string_view::npos;
    return small ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (error != std::errc{}) return std::nullopt;
  return value;
}

Error error_at(const std::string& file, int line, int column, const std::string& message) {
  std::string place = one_line(file);
  if (line > 0) place += ":" + std::to_string(line);
  if (line > 0 && column > 0) place += ":" + std::to_string(column);
  return {place + ": " + message, ErrorKind::invalid_input};
}

}  // namespace mamo::io
