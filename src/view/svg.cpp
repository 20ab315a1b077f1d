#include "mamo/view/svg.hpp"

#include <cstdio>

namespace mamo::view {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return out;
}

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  std::string out = text;
  if (out.ends_with(".0")) out.resize(out.size() - 2);
  return out == "-0" ? "0" : out;
}

std::string path_data(const Points2& points, bool closed) {
  std::string out;
  for (const Eigen::Vector2d& p : points) out += (out.empty() ? "M" : "L") + px(p.x()) + "," + px(p.y());
  return closed ? out + "Z" : out;
}

std::string path_element(const std::string& css, const Points2& points, bool closed, const std::string& tooltip) {
  std::string out = "<path class=\"" + css + "\" d=\"" + path_data(points, closed) + "\"";
  return out + (tooltip.empty() ? "/>\n" : "><title>" + escaped(tooltip) + "</title></path>\n");
}

std::string line_element(const std::string& css, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return "<line class=\"" + css + "\" x1=\"" + px(from.x()) + "\" y1=\"" + px(from.y()) + "\" x2=\"" + px(to.x()) +
         "\" y2=\"" + px(to.y()) + "\"/>\n";
}

std::string text_element(const std::string& css, const Eigen::Vector2d& at, const std::string& text,
                         const std::string& anchor) {
  return "<text class=\"" + css + "\" x=\"" + px(at.x()) + "\" y=\"" + px(at.y()) + "\" text-anchor=\"" + anchor +
         "\">" + escaped(text) + "</text>\n";
}

}  // namespace mamo::view
