// mamo report: results files in, tables, charts and one page out.
#include "mamo/experiments/report.hpp"

#include <filesystem>

#include "checks.hpp"
#include "exit_codes.hpp"
#include "session.hpp"

#include "mamo/experiments/ompl_log.hpp"
#include "mamo/io/load.hpp"

namespace mamo::tool {
namespace {

struct ReportCommand {
  std::vector<std::string> results;
  std::string out, notes, pages;
  bool ompl_logs = false;
};

int run(const ReportCommand& command, Console& console) {
  std::error_code error;
  std::filesystem::create_directories(command.out, error);
  const auto file = [&](const std::string& name) { return (std::filesystem::path(command.out) / name).string(); };
  if (const Status status = io::check_writable(file("index.html")); !status.ok()) return fail(console, status.error());
  std::vector<Record> records;
  for (const std::string& path : command.results) {
    auto more = read_records(path);
    if (!more.ok()) return fail(console, more.error());
    if (more->empty()) console.warn(path + " holds no results");
    records.insert(records.end(), more->begin(), more->end());
  }
  if (records.empty()) return fail(console, {command.results.front() + ": no results to report"});
  const std::size_t lines = records.size();
  std::vector<std::pair<std::string, std::string>> logs;
  if (command.ompl_logs) logs = ompl_logs(records);
  const std::filesystem::path pages = command.pages.empty() ? file("pages") : command.pages;
  Report report = make_report(std::move(records), [&](const Record& r) -> std::string {
    const std::filesystem::path page = pages / page_file_name(r.run);
    std::error_code none;
    return std::filesystem::exists(page, none) ? std::filesystem::relative(page, command.out, none).string() : "";
  });
  if (!command.notes.empty()) {
    const auto notes = io::read_file(command.notes);
    if (!notes.ok()) return fail(console, notes.error());
    report.notes = *notes;
  }
  std::vector<std::pair<std::string, std::string>> files = {{"index.html", to_html(report)},
                                                            {"report.md", to_markdown(report)}};
  for (const Table& table : report.tables) files.emplace_back(table.name + ".csv", to_csv(table));
  for (const Chart& chart : report.charts) files.emplace_back(chart.name + ".svg", to_svg(chart));
  for (const Figure& figure : report.figures) files.emplace_back(figure.name + ".svg", figure.svg);
  for (auto& log : logs) files.push_back(std::move(log));
  for (const auto& [name, content] : files)
    if (const Status status = io::write_file(file(name), content); !status.ok()) return fail(console, status.error());
  std::printf("%zu runs: %zu files in %s, begin with index.html\n", lines, files.size(), command.out.c_str());
  return kSolved;
}

}  // namespace

void add_report(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("report", "Tables, charts and a page of what mamo bench measured");
  auto command = std::make_shared<ReportCommand>();
  sub->add_option("results", command->results, "Results files of mamo bench; a run in two of them counts once")
      ->type_name("RESULTS")
      ->required()
      ->check(file_name());
  sub->add_option("--out", command->out, "Folder for the files, made if need be")
      ->type_name("DIR")
      ->required()
      ->check(file_name());
  sub->add_option("--notes", command->notes, "Text that goes into the report: what a person found")
      ->type_name("FILE")
      ->check(file_name());
  sub->add_option("--pages", command->pages, "Playback pages of mamo bench --pages (default: DIR/pages)")
      ->type_name("DIR")
      ->check(file_name());
  sub->add_flag("--ompl-logs", command->ompl_logs,
                "Besides, a log for each suite and setting as ompl_benchmark_statistics reads it");
  add_console_options(*sub, session);
  sub->footer("Example:\n  mamo report bench/results/selsim_table1.jsonl --out report");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
