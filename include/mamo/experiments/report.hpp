// From records to a page that a reader can check: tables, charts, what was not solved and why, and the published
// numbers beside ours.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mamo/experiments/chart.hpp"
#include "mamo/experiments/record.hpp"

namespace mamo {

struct Table {
  std::string name;  // of its CSV file, without extension
  std::string title, caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  bool every_run = false;          // long: folded away on the page, not in the Markdown
  std::vector<std::string> links;  // empty, or per row what its first cell links to ("": nothing)
};

/// A drawn chart that is no Chart: box plots and stacked bars.
struct Figure {
  std::string name;  // of its file, without extension
  std::string title, caption, svg;
};

struct Report {
  std::string title;
  std::vector<std::string> facts;  // machine, commits, limits, weights: one line each
  std::vector<Table> tables;
  std::vector<Chart> charts;
  std::vector<Figure> figures;
  std::string notes;  // Markdown, as written by a person
};

/// A run that stands in two files counts once (the first). Every suite gets a table of results, one of comparisons, one
/// of what was not solved, one of every run, and the charts its settings allow. page_of: address of a run's playback page
/// as seen from the report, "" where there is none; may be empty.
Report make_report(std::vector<Record> records, const std::function<std::string(const Record&)>& page_of = {});

std::string to_markdown(const Report& report);
/// One self-contained page.
std::string to_html(const Report& report);
std::string to_csv(const Table& table);

/// Table I of Saleem and Likhachev (ICRA 2020): 12 objects, 2 of them fixed. Null for other planners.
struct Published {
  double success, time_s;
};
const Published* published_table1(const std::string& planner);

}  // namespace mamo
