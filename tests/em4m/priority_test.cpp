#include "mamo/em4m/priority.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mamo {
namespace {

double density(double phi1, int phi2, std::vector<double> phi3, const PriorityParameters& p) {
  return std::exp(learned_priority({phi1, phi2, std::move(phi3)}, p)[0]) / p.prior;
}

TEST(LearnedPriority, TheDensityOfTheFilledShareIntegratesToOne) {
  PriorityParameters p;
  p.phi1_alpha = 2.5;  // without a pole at 0
  double integral = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) integral += density((k + 0.5) / n, 1, {}, p) / n;
  const double phi2 = p.phi2_rate * std::exp(-p.phi2_rate);
  EXPECT_NEAR(integral / phi2, 1.0, 1e-3);
}

TEST(LearnedPriority, EachObjectMultipliesItsOwnDensity) {
  PriorityParameters p;
  p.phi2_rate = 1.5634743875;  // the published ones
  p.phi3_rate = 32.1092604858;
  p.phi3_relative = false;
  const double one = density(0.1, 2, {0.02}, p), two = density(0.1, 2, {0.02, 0.05}, p);
  EXPECT_NEAR(two / one, p.phi3_rate * std::exp(-p.phi3_rate * 0.05), 1e-9);
}

TEST(LearnedPriority, LessInTheRegionIsMorePromising) {
  const PriorityParameters p;
  EXPECT_GT(learned_priority({0.01, 1, {0.02}}, p), learned_priority({0.05, 1, {0.02}}, p));
  EXPECT_GT(learned_priority({0.01, 1, {0.02}}, p), learned_priority({0.01, 1, {0.2}}, p));
  EXPECT_GT(learned_priority({0.01, 1, {0.1}}, p), learned_priority({0.01, 2, {0.1, 0.1}}, p));
  EXPECT_TRUE(std::isinf(learned_priority({0, 0, {}}, p)[0]));
}

TEST(LearnedPriority, OneMoreObjectIsNeverMorePromisingWhereDensitiesAreRelative) {
  PriorityParameters p;
  p.phi2_rate = 1.5634743875;  // the published ones
  p.phi3_rate = 32.1092604858;
  p.phi3_relative = false;
  EXPECT_LT(density(0.1, 1, {0.02}, p), density(0.1, 2, {0.02, 0.001}, p)) << "as published, it is";
  p.phi3_relative = true;
  for (double phi3 : {0.0, 0.001, 0.1}) EXPECT_GT(density(0.1, 1, {0.02}, p), density(0.1, 2, {0.02, phi3}, p));
}

TEST(LexicographicPriority, TheFilledShareDecidesThenTheNumberThenTheLoad) {
  EXPECT_GT(lexicographic_priority({0.1, 5, {9}}), lexicographic_priority({0.2, 1, {0}}));
  EXPECT_GT(lexicographic_priority({0.1, 1, {9}}), lexicographic_priority({0.1, 2, {0}}));
  EXPECT_GT(lexicographic_priority({0.1, 1, {1}}), lexicographic_priority({0.1, 1, {2}}));
}

TEST(RegionFeatures, OnlyWhatIsInsideCounts) {
  VoxelVolume region({Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}, 0.01);
  region.add(Box{{0.2, 0.2, 0.2}}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.5, 0.5)));
  Object block;
  block.mass = 2;
  block.friction = 0.5;
  block.shapes.push_back({Box{{0.1, 0.1, 0.1}}, Eigen::Isometry3d::Identity()});
  const auto at = [&](double x) {
    return object_load(region, block, Eigen::Isometry3d(Eigen::Translation3d(x, 0.5, 0.5)));
  };
  EXPECT_NEAR(at(0.5).share, 1.0, 1e-9);
  EXPECT_NEAR(at(0.5).weighted_share, 1.0, 1e-9);
  EXPECT_EQ(at(0.8).cells, 0);
  const RegionFeatures features = region_features(region, {at(0.5), at(0.8), at(0.55)});
  EXPECT_EQ(features.phi2, 2);
  EXPECT_NEAR(features.phi1, 2000.0 / static_cast<double>(region.count()), 1e-3);
}

}  // namespace
}  // namespace mamo
