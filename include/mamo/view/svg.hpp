// Pieces of SVG and HTML text: escaped strings, rounded numbers, paths. Shared by top views, charts and pages.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace mamo::view {

using Points2 = std::vector<Eigen::Vector2d>;

/// Text for element content and attributes; control characters become blanks.
std::string escaped(const std::string& text);
/// "12.3", "-4", never "-0".
std::string px(double value);
/// "M1,2L3,4" and "Z" if closed.
std::string path_data(const Points2& points, bool closed);
/// <path class="..." d="..."/>, with an optional <title> that browsers show as a tooltip.
std::string path_element(const std::string& css, const Points2& points, bool closed, const std::string& tooltip = {});
std::string line_element(const std::string& css, const Eigen::Vector2d& from, const Eigen::Vector2d& to);
std::string text_element(const std::string& css, const Eigen::Vector2d& at, const std::string& text,
                         const std::string& anchor = "start");

}  // namespace mamo::view
