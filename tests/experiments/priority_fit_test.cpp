#include "mamo/experiments/priority_fit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mamo/common/random.hpp"
#include "mamo/em4m/em4m_planner.hpp"
#include "mamo/io/load.hpp"

namespace mamo {
namespace {

/// The k-th smallest of n uniform numbers has the density Beta(k, n + 1 - k).
std::vector<double> order_statistics(int k, int n, int count, std::uint64_t seed) {
  RandomStream random(seed, {1});
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    std::vector<double> u;
    for (int j = 0; j < n; ++j) u.push_back(random.uniform());
    std::sort(u.begin(), u.end());
    values.push_back(u[static_cast<std::size_t>(k - 1)]);
  }
  return values;
}

double log_likelihood(const std::vector<double>& values, double a, double b) {
  double sum = 0;
  for (double v : values) sum += (a - 1) * std::log(v) + (b - 1) * std::log1p(-v);
  return sum - static_cast<double>(values.size()) * (std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b));
}

TEST(FitBeta, FindsTheParametersThatMadeTheValues) {
  for (const auto& [k, n] : {std::pair(2, 6), std::pair(1, 8), std::pair(5, 6)}) {
    const auto [a, b] = fit_beta(order_statistics(k, n, 20000, 3));
    EXPECT_NEAR(a / k, 1, 0.03) << k << " of " << n;
    EXPECT_NEAR(b / (n + 1 - k), 1, 0.03) << k << " of " << n;
  }
}

TEST(FitBeta, NoNeighbourIsMoreLikely) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<double> values = order_statistics(1 + static_cast<int>(seed % 3), 4, 30, seed);
    if (seed % 2 == 0)
      for (double& v : values) v = v * v * v * 1e-2;  // much near 0, as a region's filled share is
    const auto [a, b] = fit_beta(values);
    const double best = log_likelihood(values, a, b);
    for (double fa : {0.99, 1.0, 1.01})
      for (double fb : {0.99, 1.0, 1.01}) EXPECT_LE(log_likelihood(values, a * fa, b * fb), best + 1e-9);
  }
}

std::vector<TrainingPoint> points() {
  return {{{0.02, 1, {0.1}}, true},
          {{0.04, 2, {0.1, 0.3}}, true},
          {{0.06, 3, {0.0, 0.1, 0.2}}, true},
          {{0.05, 1, {0.1}}, true},
          {{0.03, 3, {0.1, 0.1, 0.1}}, true},
          {{0.9, 9, {9}}, false},
          {{0.0, 0, {}}, true},
          {{0.8, 8, {8}}, false}};
}

TEST(FitPriority, CountsWhatLedToASolutionOnly) {
  const Result<PriorityFit> fit = fit_priority(points());
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_EQ(fit->points, 8);
  EXPECT_EQ(fit->solved, 6);
  EXPECT_EQ(fit->free, 1);
  EXPECT_DOUBLE_EQ(fit->parameters.prior, 6.0 / 8);
  EXPECT_DOUBLE_EQ(fit->parameters.phi2_rate, 1.0) << "one over the mean of 0, 1, 2, 0 and 2";
  EXPECT_NEAR(fit->parameters.phi3_rate, 10 / 1.2, 1e-9);
  EXPECT_NEAR(fit->parameters.phi1_alpha / (fit->parameters.phi1_alpha + fit->parameters.phi1_beta), 0.04, 0.001);
}

TEST(FitPriority, RefusesTooFewPoints) {
  std::vector<TrainingPoint> few = points();
  few.erase(few.begin());
  EXPECT_FALSE(fit_priority(few).ok());
  EXPECT_FALSE(fit_priority({}).ok());
}

TEST(ParametersYaml, NamesOptionsOfThePlanner) {
  const std::string text = parameters_yaml(fit_priority(points())->parameters, "about\nthis");
  EXPECT_THAT(text, testing::StartsWith("# about\n# this\npriority_prior: 0.75\n"));
  int named = 0;
  for (const OptionDoc& option : em4m_options())
    if (option.name.starts_with("priority_")) {
      ++named;
      EXPECT_THAT(text, testing::HasSubstr("\n" + option.name + ": "));
    }
  EXPECT_EQ(named, 6);
}

/// Lines of a parameters file that are no comment.
std::string values(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("#")) kept += line + "\n";
  return kept;
}

TEST(ParametersYaml, TheShippedFileHoldsTheDefaults) {
  const std::string folder = MAMO_SOURCE_DIR;
  const auto shipped = io::read_file(folder + "/bench/data/em4m_priority.yaml");
  ASSERT_TRUE(shipped.ok()) << shipped.error().message;
  EXPECT_EQ(values(*shipped), values(parameters_yaml(PriorityParameters(), "")));
}

TEST(FitSvg, ShowsAllThreeFeatures) {
  const std::string svg = fit_svg(points(), *fit_priority(points()));
  for (const char* word : {"phi1", "phi2", "phi3", "fitted", "data (5 values)"})
    EXPECT_THAT(svg, testing::HasSubstr(word));
}

}  // namespace
}  // namespace mamo
