#include "mamo/experiments/priority_fit.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "io/text.hpp"

#include "mamo/experiments/chart.hpp"
#include "mamo/view/svg.hpp"

namespace mamo {
namespace {

constexpr int kLeastPoints = 5;
constexpr double kLeastMean = 1e-3;  // of what exponential densities are fitted to
constexpr double kEdge = 1e-9;       // phi1 is kept this far from 0 and 1, where the density may have poles

/// The features of the points that the densities are fitted to.
struct Samples {
  std::vector<double> phi1, phi2, phi3;
};

Samples samples_of(const std::vector<TrainingPoint>& points) {
  Samples s;
  for (const TrainingPoint& point : points) {
    if (!point.solved || point.features.phi2 == 0) continue;
    s.phi1.push_back(std::clamp(point.features.phi1, kEdge, 1 - kEdge));
    s.phi2.push_back(point.features.phi2);
    s.phi3.insert(s.phi3.end(), point.features.phi3.begin(), point.features.phi3.end());
  }
  return s;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Method of moments: where Newton's method begins.
std::pair<double, double> beta_by_moments(const std::vector<double>& values) {
  const double m = mean(values);
  double variance = 0;
  for (double v : values) variance += (v - m) * (v - m) / static_cast<double>(values.size());
  const double common = std::max(1e-3, m * (1 - m) / std::max(variance, 1e-12) - 1);
  return {std::max(1e-3, m * common), std::max(1e-3, (1 - m) * common)};
}

Chart panel(const char* name, const char* x_label, std::vector<double> values,
            const std::function<double(double)>& fitted, bool log_x) {
  std::sort(values.begin(), values.end());
  Chart chart;
  chart.name = name;
  chart.title = std::string(name) + " where it led to a solution";
  chart.x_label = x_label;
  chart.y_label = "share at or below";
  chart.log_x = log_x;
  Series data{"data (" + std::to_string(values.size()) + " values)", {}, true, false, -1};
  for (std::size_t i = 0; i < values.size(); ++i)
    data.points.emplace_back(std::max(values[i], 1e-6),
                             static_cast<double>(i + 1) / static_cast<double>(values.size()));
  Series curve{"fitted", {}, false, false, -1};
  const double low = std::max(values.front(), 1e-6), high = values.back();
  for (int i = 0; i <= 40; ++i) {
    const double x = log_x ? low * std::pow(high / low, i / 40.0) : low + (high - low) * i / 40;
    curve.points.emplace_back(x, fitted(x));
  }
  curve.steps = true;  // no marks: forty of them hide the data
  chart.series = {std::move(data), std::move(curve)};
  return chart;
}

}  // namespace

std::pair<double, double> fit_beta(const std::vector<double>& values) {
  using boost::math::digamma;
  using boost::math::trigamma;
  double log_x = 0, log_rest = 0;
  for (double v : values) {
    log_x += std::log(v) / static_cast<double>(values.size());
    log_rest += std::log1p(-v) / static_cast<double>(values.size());
  }
  auto [a, b] = beta_by_moments(values);
  for (int step = 0; step < 200; ++step) {
    const double sum = digamma(a + b), turn = trigamma(a + b);
    const double ga = digamma(a) - sum - log_x, gb = digamma(b) - sum - log_rest;
    const double haa = trigamma(a) - turn, hbb = trigamma(b) - turn, hab = -turn;
    const double determinant = haa * hbb - hab * hab;  // of the (positive definite) Hessian
    double da = (hbb * ga - hab * gb) / determinant, db = (haa * gb - hab * ga) / determinant;
    // Half the way to 0 at most: both stay positive.
    const double shrink = std::min({1.0, da > 0 ? 0.5 * a / da : 1.0, db > 0 ? 0.5 * b / db : 1.0});
    a -= shrink * da;
    b -= shrink * db;
    if (std::abs(da) <= 1e-12 * a && std::abs(db) <= 1e-12 * b) break;
  }
  return {a, b};
}

Result<PriorityFit> fit_priority(const std::vector<TrainingPoint>& points) {
  PriorityFit fit;
  fit.points = static_cast<int>(points.size());
  for (const TrainingPoint& point : points) {
    fit.solved += point.solved;
    fit.free += point.features.phi2 == 0;
  }
  const Samples s = samples_of(points);
  if (static_cast<int>(s.phi1.size()) < kLeastPoints)
    return Error{"only " + std::to_string(s.phi1.size()) +
                 " rearrangements led to a solution, too few to fit densities"};
  if (*std::min_element(s.phi1.begin(), s.phi1.end()) == *std::max_element(s.phi1.begin(), s.phi1.end()))
    return Error{"all rearrangements that led to a solution fill the same share of the region"};
  PriorityParameters& p = fit.parameters;
  p.prior = static_cast<double>(fit.solved) / static_cast<double>(fit.points);
  std::tie(p.phi1_alpha, p.phi1_beta) = fit_beta(s.phi1);
  p.phi2_rate = 1 / std::max(mean(s.phi2) - 1, kLeastMean);
  p.phi3_rate = 1 / std::max(mean(s.phi3), kLeastMean);
  return fit;
}

std::string parameters_yaml(const PriorityParameters& p, const std::string& about) {
  std::string text = "# ";
  for (char c : about) text += c == '\n' ? std::string("\n# ") : std::string(1, c);
  const auto add = [&](const char* name, double value) {
    text += std::string("\n") + name + ": " + io::shortest_number(value);
  };
  add("priority_prior", p.prior);
  add("priority_phi1_alpha", p.phi1_alpha);
  add("priority_phi1_beta", p.phi1_beta);
  add("priority_phi2_rate", p.phi2_rate);
  add("priority_phi3_rate", p.phi3_rate);
  return text + "\npriority_phi3_relative: " + (p.phi3_relative ? "true" : "false") + "\n";
}

std::string fit_svg(const std::vector<TrainingPoint>& points, const PriorityFit& fit) {
  const Samples s = samples_of(points);
  const PriorityParameters& p = fit.parameters;
  const auto beta = [&](double x) { return boost::math::ibeta(p.phi1_alpha, p.phi1_beta, std::clamp(x, 0.0, 1.0)); };
  const auto exponential = [](double rate) { return [rate](double x) { return -std::expm1(-rate * x); }; };
  const Chart charts[] = {
      panel("phi1", "share of the region that movables fill", s.phi1, beta, true),
      panel(
          "phi2", "movables in the region", s.phi2, [&](double x) { return exponential(p.phi2_rate)(x - 1); }, false),
      panel("phi3", "mass times friction times share inside, of each (kg)", s.phi3, exponential(p.phi3_rate), true)};
  constexpr double kWidth = 640, kHeight = 440;
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + view::px(kWidth) + " " +
                     view::px(3 * kHeight) + "\">\n";
  double y = 0;
  for (const Chart& chart : charts) {
    std::string inner = to_svg(chart);
    const std::string head = "<svg class=\"chart\" ";
    inner.insert(head.size(),
                 "y=\"" + view::px(y) + "\" width=\"" + view::px(kWidth) + "\" height=\"" + view::px(kHeight) + "\" ");
    text += inner;
    y += kHeight;
  }
  return text + "</svg>\n";
}

}  // namespace mamo
