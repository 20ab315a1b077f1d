#include "mamo/experiments/report.hpp"

namespace mamo {
namespace {

std::string cell(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '|' ? "\\|" : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& c : cells) text += " " + cell(c) + " |";
  return text + "\n";
}

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& c : cells) text += std::string("<") + tag + ">" + escape_markup(c) + "</" + tag + ">";
  return text + "</tr>\n";
}

std::string html_table(const Table& table) {
  std::string text = "<h2>" + escape_markup(table.title) + "</h2>\n";
  if (!table.caption.empty()) text += "<p>" + escape_markup(table.caption) + "</p>\n";
  text += "<div class=\"wide\"><table><thead>" + html_row(table.header, "th") + "</thead><tbody>\n";
  for (const auto& row : table.rows) text += html_row(row, "td");
  return text + "</tbody></table></div>\n";
}

constexpr const char* kStyle =
    ":root{color-scheme:light dark;--ink:#222;--paper:#fff;--faint:#ddd}"
    "@media(prefers-color-scheme:dark){:root{--ink:#ddd;--paper:#16181c;--faint:#3a3d44}}"
    "body{font:16px/1.5 sans-serif;color:var(--ink);background:var(--paper);max-width:70rem;margin:2rem auto;"
    "padding:0 1rem}.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px}"
    "th,td{padding:.25rem .5rem;border-bottom:1px solid var(--faint);text-align:left;white-space:nowrap}"
    "figure{max-width:640px;margin:1.5rem 0}figure svg{width:100%}figcaption,pre{font-size:13px;white-space:pre-wrap}";

}  // namespace

std::string to_markdown(const Report& report) {
  std::string text = "# " + report.title + "\n\n";
  for (const std::string& fact : report.facts) text += "- " + fact + "\n";
  if (!report.notes.empty()) text += "\n" + report.notes + "\n";
  for (const Table& table : report.tables) {
    text += "\n## " + table.title + "\n\n";
    if (!table.caption.empty()) text += table.caption + "\n\n";
    text += markdown_row(table.header) + markdown_row(std::vector<std::string>(table.header.size(), "---"));
    for (const auto& row : table.rows) text += markdown_row(row);
  }
  for (const Chart& chart : report.charts)
    text += "\n![" + chart.title + "](" + chart.name + ".svg)\n\n" + chart.caption + "\n";
  return text;
}

std::string to_html(const Report& report) {
  std::string text =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      escape_markup(report.title) + "</title>\n<style>" + kStyle + "</style></head><body>\n<h1>" +
      escape_markup(report.title) + "</h1>\n<ul>\n";
  for (const std::string& fact : report.facts) text += "<li>" + escape_markup(fact) + "</li>\n";
  text += "</ul>\n";
  if (!report.notes.empty()) text += "<pre>" + escape_markup(report.notes) + "</pre>\n";
  for (const Chart& chart : report.charts)
    text += "<figure>\n" + to_svg(chart) + "<figcaption>" + escape_markup(chart.caption) + "</figcaption></figure>\n";
  for (const Table& table : report.tables) text += html_table(table);
  return text + "</body></html>\n";
}

std::string to_csv(const Table& table) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::string quoted;
      for (char c : cells[i]) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      text += (i ? "," : "") + (quoted.find_first_of("\",\n") == std::string::npos ? quoted : "\"" + quoted + "\"");
    }
    text += "\n";
  };
  add(table.header);
  for (const auto& row : table.rows) add(row);
  return text;
}

}  // namespace mamo
