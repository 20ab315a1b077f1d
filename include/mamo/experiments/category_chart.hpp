// Charts over categories (classes of difficulty, say), several series side by side in each: box plots and stacked bars,
// as self-contained SVG.
#pragma once

#include <string>
#include <vector>

namespace mamo {

struct BoxChart {
  std::string name;  // of its file, without extension
  std::string title, y_label, caption;
  std::vector<std::string> categories, series;
  std::vector<std::vector<std::vector<double>>> values;  // [category][series]: a sample each, in any order
  double least = 0.01;                                   // the axis is logarithmic; smaller values stand here
};
/// Box: quartiles and median; whiskers: 5 % and 95 %.
std::string to_svg(const BoxChart& chart);

struct StackChart {
  std::string name;
  std::string title, y_label, caption;
  std::vector<std::string> categories, series, parts;     // parts from the bottom up
  std::vector<std::vector<std::vector<double>>> heights;  // [category][series][part]; an empty stack is not drawn
};
std::string to_svg(const StackChart& chart);

}  // namespace mamo
