#include "mamo/experiments/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/chart_style.hpp"

#include "mamo/view/svg.hpp"

namespace mamo {
namespace {

using view::escaped;
using view::px;

// px
constexpr double kWidth = 640, kHeight = 400, kLeft = 62, kRight = 18, kTop = 40, kBottom = 52;
constexpr double kLegendRow = 18;
// Lines that lie on one another stay visible.
constexpr std::array<const char*, 3> kDashes = {"", "\" stroke-dasharray=\"8 4", "\" stroke-dasharray=\"2 4"};

constexpr auto label = chart_number;

/// The axis of x: its range, and where its ticks are.
struct Axis {
  double low = 0, high = 1;
  bool log = false;
  std::vector<double> ticks;
  double share(double x) const {
    return log ? (std::log10(x) - std::log10(low)) / (std::log10(high) - std::log10(low)) : (x - low) / (high - low);
  }
};

double round_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

Axis x_axis(const Chart& chart) {
  Axis axis;
  axis.log = chart.log_x;
  double low = INFINITY, high = -INFINITY;
  for (const Series& series : chart.series)
    for (const auto& [x, y] : series.points)
      if (!axis.log || x > 0) low = std::min(low, x), high = std::max(high, x);
  if (!(low <= high)) low = high = 1;
  if (axis.log) {
    axis.low = std::pow(10, std::floor(std::log10(low)));
    axis.high = std::pow(10, std::max(std::ceil(std::log10(high)), std::log10(axis.low) + 1));
    for (double t = axis.low; t <= axis.high * 1.001; t *= 10) axis.ticks.push_back(t);
  } else {
    const double step = std::max(1.0, round_step(std::max(high - low, 1.0) / 10));
    axis.low = std::floor(low / step) * step - step / 2;
    axis.high = std::ceil(high / step) * step + step / 2;
    for (double t = axis.low + step / 2; t <= axis.high; t += step) axis.ticks.push_back(t);
  }
  return axis;
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart), axis_(x_axis(chart)) {}

  std::string svg() {
    const double height = kHeight + kLegendRow * static_cast<double>(chart_.series.size());
    text_ = chart_sheet(kWidth, height, chart_.title);
    text_at(kLeft, 22, chart_.title, "start", "title");
    axes();
    for (std::size_t i = 0; i < chart_.series.size(); ++i) draw(chart_.series[i], i);
    return text_ + "</svg>\n";
  }

 private:
  double at_x(double x) const { return kLeft + axis_.share(x) * (kWidth - kLeft - kRight); }
  double at_y(double y) const { return kHeight - kBottom - y / chart_.y_max * (kHeight - kTop - kBottom); }

  void text_at(double x, double y, const std::string& text, const char* anchor, const char* css = "label") {
    text_ += view::text_element(css, {x, y}, text, anchor);
  }
  void line(const char* css, double x1, double y1, double x2, double y2) {
    text_ += view::line_element(css, {x1, y1}, {x2, y2});
  }

  void axes() {
    const double bottom = at_y(0);
    for (int i = 0; i <= 5; ++i) {
      const double y = chart_.y_max * i / 5;
      line("grid", kLeft, at_y(y), kWidth - kRight, at_y(y));
      text_at(kLeft - 8, at_y(y) + 4, label(y), "end");
    }
    for (double tick : axis_.ticks) {
      line("axis", at_x(tick), bottom, at_x(tick), bottom + 5);
      text_at(at_x(tick), bottom + 19, label(tick), "middle");
    }
    line("axis", kLeft, bottom, kWidth - kRight, bottom);
    line("axis", kLeft, kTop, kLeft, bottom);
    text_at((kLeft + kWidth - kRight) / 2, bottom + 40, chart_.x_label, "middle");
    text_ += "<g transform=\"translate(16," + px((kTop + bottom) / 2) + ") rotate(-90)\">";
    text_at(0, 0, chart_.y_label, "middle");
    text_ += "</g>\n";
  }

  void mark(double x, double y, const std::string& colour, bool hollow, const std::string& tooltip) {
    text_ += std::string("<circle") + (hollow ? " class=\"hollow\" stroke=\"" : " fill=\"") + colour + "\" cx=\"" +
             px(x) + "\" cy=\"" + px(y) + "\" r=\"" + (hollow ? "6" : "4") + "\"><title>" + escaped(tooltip) +
             "</title></circle>\n";
  }

  void draw(const Series& series, std::size_t index) {
    const std::size_t own = series.colour >= 0 ? static_cast<std::size_t>(series.colour) : index;
    const std::string colour = kChartColours[own % kChartColours.size()];
    std::string path;
    double last_y = 0;
    for (const auto& [x, y] : series.points) {
      if (axis_.log && x <= 0) continue;
      if (series.steps && !path.empty()) path += "L" + px(at_x(x)) + "," + px(at_y(last_y));
      path += (path.empty() ? "M" : "L") + px(at_x(x)) + "," + px(at_y(y));
      last_y = y;
    }
    if (!series.published && !path.empty())
      text_ += std::string("<path class=\"line\" stroke=\"") + colour + kDashes[own % kDashes.size()] + "\" d=\"" +
               path + "\"/>\n";
    if (!series.steps)
      for (const auto& [x, y] : series.points)
        if (!axis_.log || x > 0) mark(at_x(x), at_y(y), colour, series.published, series.name + ": " + label(y));
    const double y = kHeight + kLegendRow * static_cast<double>(index);
    mark(kLeft + 8, y - 4, colour, series.published, series.name);
    text_at(kLeft + 22, y, series.name, "start");
  }

  const Chart& chart_;
  const Axis axis_;
  std::string text_;
};

}  // namespace

std::string chart_sheet(double width, double height, const std::string& title) {
  return "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width) + " " + px(height) +
         "\" role=\"img\" aria-label=\"" + escaped(title) + "\">\n<style>" + kChartStyle +
         "</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n";
}

std::string to_svg(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace mamo
