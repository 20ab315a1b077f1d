#include "mamo/experiments/chart.hpp"

#include <gmock/gmock.h>

namespace mamo {
namespace {

using testing::HasSubstr;
using testing::Not;

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Chart, DrawsEverySeriesInsideItsFrame) {
  Chart chart;
  chart.title = "a < b";
  chart.series = {{"one", {{6, 1.0}, {20, 0.0}}}, {"two", {{6, 0.5}}}};
  const std::string svg = to_svg(chart);
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_EQ(count(svg, "class=\"line\""), 2);
  EXPECT_EQ(count(svg, "<circle"), 3 + 2) << "a mark for each point and for each name in the legend";
  EXPECT_THAT(svg, HasSubstr("cy=\"40\"")) << "1 is the upper edge";
  EXPECT_THAT(svg, HasSubstr("cy=\"348\"")) << "0 is the axis";
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
}

TEST(Chart, PublishedNumbersAreHollowMarksInTheColourOfTheirPlanner) {
  Chart chart;
  Series ours{"ours", {{2, 0.9}}};
  Series published{"published", {{2, 0.4}}};
  published.published = true;
  published.colour = 0;
  chart.series = {ours, published};
  const std::string svg = to_svg(chart);
  EXPECT_EQ(count(svg, "class=\"line\""), 1);
  EXPECT_EQ(count(svg, "class=\"hollow\" stroke=\"#0072b2\""), 2);
}

TEST(Chart, WithoutPointsHoldsNoNumberThatIsNone) {
  for (bool log_x : {false, true}) {
    Chart chart;
    chart.log_x = log_x;
    chart.series = {{"nothing solved", {}}, {"zero", {{0, 0.0}}}};
    EXPECT_THAT(to_svg(chart), testing::AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  }
}

}  // namespace
}  // namespace mamo
