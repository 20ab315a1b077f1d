#include "mamo/experiments/report.hpp"
#include "mamo/view/page.hpp"
#include "mamo/view/svg.hpp"

namespace mamo {
namespace {

using view::escaped;

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

/// link: of the first cell; empty for none.
std::string html_row(const std::vector<std::string>& cells, const char* tag, const std::string& link = "") {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string cell = escaped(cells[i]);
    if (i == 0 && !link.empty()) cell = "<a href=\"" + escaped(link) + "\">" + cell + "</a>";
    text += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  }
  return text + "</tr>\n";
}

std::string html_table(const Table& table) {
  std::string text = "<h2 id=\"" + escaped(table.name) + "\">" + escaped(table.title) + "</h2>\n";
  if (!table.caption.empty()) text += "<p>" + escaped(table.caption) + "</p>\n";
  if (table.every_run) text += "<details><summary>" + std::to_string(table.rows.size()) + " runs</summary>\n";
  text += "<div class=\"wide\"><table class=\"data\"><thead>" + html_row(table.header, "th") + "</thead><tbody>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    text += html_row(table.rows[i], "td", i < table.links.size() ? table.links[i] : "");
  text += "</tbody></table></div>\n";
  return text + (table.every_run ? "</details>\n" : "");
}

}  // namespace

std::string to_markdown(const Report& report) {
  std::string text = "# " + report.title + "\n\n";
  for (const std::string& fact : report.facts) text += "- " + fact + "\n";
  if (!report.notes.empty()) text += "\n" + report.notes + "\n";
  for (const Table& table : report.tables) {
    if (table.every_run) continue;
    text += "\n## " + table.title + "\n\n";
    if (!table.caption.empty()) text += table.caption + "\n\n";
    text += markdown_row(table.header) + markdown_row(std::vector<std::string>(table.header.size(), "---"));
    for (const auto& row : table.rows) text += markdown_row(row);
  }
  for (const Figure& figure : report.figures)
    text += "\n![" + figure.title + "](" + figure.name + ".svg)\n\n" + figure.caption + "\n";
  for (const Chart& chart : report.charts)
    text += "\n![" + chart.title + "](" + chart.name + ".svg)\n\n" + chart.caption + "\n";
  return text;
}

std::string to_html(const Report& report) {
  std::string text = "<ul>\n";
  for (const std::string& fact : report.facts) text += "<li>" + escaped(fact) + "</li>\n";
  text += "</ul>\n";
  if (!report.notes.empty()) text += "<pre>" + escaped(report.notes) + "</pre>\n";
  const bool drawn = !report.charts.empty() || !report.figures.empty();
  if (drawn) text += "<div class=\"charts\">\n";
  for (const Figure& figure : report.figures)
    text += "<figure>\n" + figure.svg + "<figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
  for (const Chart& chart : report.charts)
    text += "<figure>\n" + to_svg(chart) + "<figcaption>" + escaped(chart.caption) + "</figcaption></figure>\n";
  if (drawn) text += "</div>\n";
  for (const Table& table : report.tables) text += html_table(table);
  return view::document_page(report.title, text);
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
