#include "mamo/experiments/category_chart.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/chart_style.hpp"

#include "mamo/experiments/statistics.hpp"
#include "mamo/view/svg.hpp"

namespace mamo {
namespace {

using view::escaped;
using view::px;

// px
constexpr double kHeight = 400, kLeft = 62, kRight = 18, kTop = 40, kBottom = 52, kLegendRow = 18;
constexpr double kSlot = 26, kGroupGap = 30, kLeastWidth = 640;

std::string fill(std::size_t index) {
  return std::string(" fill=\"") + kChartColours[index % kChartColours.size()] + "\"";
}

/// Where things stand: groups of slots along x, a linear or logarithmic y.
struct Layout {
  std::size_t groups, slots;
  double low, high;
  bool log;

  double group_width() const { return kSlot * static_cast<double>(slots) + kGroupGap; }
  double width() const { return std::max(kLeastWidth, kLeft + kRight + group_width() * static_cast<double>(groups)); }
  double slot(std::size_t group, std::size_t index) const {  // its middle
    return kLeft + group_width() * static_cast<double>(group) + kGroupGap / 2 +
           kSlot * (static_cast<double>(index) + 0.5);
  }
  double y(double value) const {
    const double share = log ? (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low))
                             : (value - low) / (high - low);
    return kHeight - kBottom - share * (kHeight - kTop - kBottom);
  }
};

/// An SVG that grows as things are drawn.
class Paper {
 public:
  Paper(double width, double height, const std::string& title) : text_(chart_sheet(width, height, title)) {}
  void text_at(double x, double y, const std::string& text, const char* anchor, const char* css = "label") {
    text_ += view::text_element(css, {x, y}, text, anchor);
  }
  /// Turned about its place (degrees).
  void turned_text_at(double x, double y, double angle, const std::string& text, const char* anchor) {
    text_ += "<g transform=\"translate(" + px(x) + "," + px(y) + ") rotate(" + px(angle) + ")\">";
    text_at(0, 0, text, anchor);
    text_ += "</g>\n";
  }
  void line(const char* css, double x1, double y1, double x2, double y2) {
    text_ += view::line_element(css, {x1, y1}, {x2, y2});
  }
  void add(const std::string& markup) { text_ += markup; }
  std::string finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

Paper begin(const Layout& layout, const std::string& title, const std::string& y_label,
            const std::vector<std::string>& categories, const std::vector<std::string>& legend, bool name_slots,
            const std::vector<std::string>& series) {
  const double rows = static_cast<double>(legend.size());
  Paper paper(layout.width(), kHeight + (name_slots ? 70 : 0) + kLegendRow * rows, title);
  paper.text_at(kLeft, 22, title, "start", "title");
  std::vector<double> ticks;
  if (layout.log)
    for (double t = layout.low; t <= layout.high * 1.001; t *= 10) ticks.push_back(t);
  else
    for (int i = 0; i <= 5; ++i) ticks.push_back(layout.low + (layout.high - layout.low) * i / 5);
  for (double t : ticks) {
    paper.line("grid", kLeft, layout.y(t), layout.width() - kRight, layout.y(t));
    paper.text_at(kLeft - 8, layout.y(t) + 4, chart_number(t), "end");
  }
  const double bottom = kHeight - kBottom;
  paper.line("axis", kLeft, bottom, layout.width() - kRight, bottom);
  paper.line("axis", kLeft, kTop, kLeft, bottom);
  paper.turned_text_at(16, (kTop + bottom) / 2, -90, y_label, "middle");
  for (std::size_t g = 0; g < categories.size(); ++g) {
    const double middle = (layout.slot(g, 0) + layout.slot(g, layout.slots - 1)) / 2;
    paper.text_at(middle, kTop - 6, categories[g], "middle");
    for (std::size_t s = 0; name_slots && s < series.size(); ++s)
      paper.turned_text_at(layout.slot(g, s) + 4, bottom + 10, -60, series[s], "end");
  }
  for (std::size_t k = 0; k < legend.size(); ++k) {
    const double y = kHeight + (name_slots ? 70 : 0) + kLegendRow * static_cast<double>(k) - 14;
    paper.add("<rect x=\"" + px(kLeft) + "\" y=\"" + px(y - 10) + "\" width=\"12\" height=\"12\"" + fill(k) + "/>\n");
    paper.text_at(kLeft + 20, y, legend[k], "start");
  }
  return paper;
}

void draw_box(Paper& paper, const Layout& layout, double x, std::size_t colour, const std::vector<double>& sample,
              const std::string& name) {
  double at[5];
  const double shares[5] = {0.05, 0.25, 0.5, 0.75, 0.95};
  for (int i = 0; i < 5; ++i) at[i] = layout.y(std::clamp(percentile(sample, shares[i]), layout.low, layout.high));
  const double half = kSlot * 0.36;
  paper.line("axis", x, at[0], x, at[1]);
  paper.line("axis", x, at[3], x, at[4]);
  for (double end : {at[0], at[4]}) paper.line("axis", x - half / 2, end, x + half / 2, end);
  paper.add("<rect x=\"" + px(x - half) + "\" y=\"" + px(at[3]) + "\" width=\"" + px(2 * half) + "\" height=\"" +
            px(std::max(1.0, at[1] - at[3])) + "\"" + fill(colour) + "><title>" +
            escaped(name + ": median " + chart_number(percentile(sample, 0.5))) + "</title></rect>\n");
  paper.line("axis", x - half, at[2], x + half, at[2]);
}

}  // namespace

std::string to_svg(const BoxChart& chart) {
  double most = chart.least * 10;
  for (const auto& category : chart.values)
    for (const auto& sample : category)
      for (double v : sample)
        if (std::isfinite(v)) most = std::max(most, v);
  const Layout layout{chart.categories.size(), std::max<std::size_t>(1, chart.series.size()), chart.least,
                      std::pow(10, std::ceil(std::log10(most) - 1e-9)), true};
  Paper paper = begin(layout, chart.title, chart.y_label, chart.categories, chart.series, false, chart.series);
  for (std::size_t g = 0; g < chart.values.size(); ++g)
    for (std::size_t s = 0; s < chart.values[g].size(); ++s)
      if (!chart.values[g][s].empty())
        draw_box(paper, layout, layout.slot(g, s), s, chart.values[g][s], chart.series[s]);
  return paper.finish();
}

std::string to_svg(const StackChart& chart) {
  double most = 0;
  for (const auto& category : chart.heights)
    for (const auto& stack : category) {
      double sum = 0;
      for (double part : stack) sum += part;
      most = std::max(most, sum);
    }
  if (!(most > 0)) most = 1;
  const double power = std::pow(10, std::floor(std::log10(most)));
  const Layout layout{chart.categories.size(), std::max<std::size_t>(1, chart.series.size()), 0,
                      std::ceil(most / power * 2) / 2 * power, false};
  Paper paper = begin(layout, chart.title, chart.y_label, chart.categories, chart.parts, true, chart.series);
  for (std::size_t g = 0; g < chart.heights.size(); ++g)
    for (std::size_t s = 0; s < chart.heights[g].size(); ++s) {
      double below = 0;
      for (std::size_t k = 0; k < chart.heights[g][s].size(); ++k) {
        const double part = chart.heights[g][s][k], top = layout.y(below + part);
        paper.add("<rect x=\"" + px(layout.slot(g, s) - kSlot * 0.36) + "\" y=\"" + px(top) + "\" width=\"" +
                  px(kSlot * 0.72) + "\" height=\"" + px(layout.y(below) - top) + "\"" + fill(k) + "><title>" +
                  escaped(chart.series[s] + ", " + chart.parts[k] + ": " + chart_number(part)) + "</title></rect>\n");
        below += part;
      }
    }
  return paper.finish();
}

}  // namespace mamo
