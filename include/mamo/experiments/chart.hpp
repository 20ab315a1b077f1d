// Line charts as self-contained SVG, readable on light and on dark pages.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mamo {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  // in order of x
  bool steps = false;                             // y holds until the next x
  bool published = false;                         // hollow marks, no line
  int colour = -1;                                // shared with the series of that index; -1: its own
};

struct Chart {
  std::string name;  // of its file, without extension
  std::string title, x_label, y_label, caption;
  bool log_x = false;
  double y_max = 1;
  std::vector<Series> series;
};

std::string to_svg(const Chart& chart);

}  // namespace mamo
