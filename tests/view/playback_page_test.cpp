// Pages and pictures as text and bytes; playback_test.py opens them in a browser.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support/table_world.hpp"
#include "view/page_template.hpp"
#include "view/series.hpp"
#include "view/triangles.hpp"

#include "mamo/verify/verifier.hpp"
#include "mamo/view/playback.hpp"

namespace mamo::view {
namespace {

using namespace fixtures;
using testing::HasSubstr;

/// The inverse of series(), written from its description.
std::vector<double> decoded(const nlohmann::json& series) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string text = series["d"];
  std::vector<int> bytes;
  int bits = 0, held = 0;
  for (char c : text) {
    if (c == '=') break;
    held = (held << 6) | static_cast<int>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back((held >> bits) & 255);
  }
  std::size_t at = 0;
  const auto next = [&] {
    std::int64_t value = 0, shift = 0;
    for (;; shift += 7) {
      const int byte = bytes.at(at++);
      value |= static_cast<std::int64_t>(byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  std::vector<double> out;
  std::int64_t last = 0;
  while (out.size() < series["n"].get<std::size_t>()) {
    const std::int64_t coded = next();
    std::int64_t more = 0;
    if (coded == 0)
      more = next();
    else
      last += coded % 2 ? -(coded + 1) / 2 : coded / 2;
    for (std::int64_t k = 0; k <= more; ++k) out.push_back(static_cast<double>(last) * series["u"].get<double>());
  }
  return out;
}

TEST(Series, AreWithinHalfAUnitOfWhatWentIn) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, {0x736572});
    std::vector<double> values;
    double v = random.uniform(-3, 3);
    const int n = static_cast<int>(random.uniform(0, 200));
    for (int k = 0; k < n; ++k) {
      if (random.uniform(0, 1) < 0.4) v += random.uniform(-0.5, 0.5) * std::pow(10, random.uniform(-5, 2));
      values.push_back(v);
    }
    const std::vector<double> back = decoded(series(values, 1e-4));
    ASSERT_EQ(back.size(), values.size());
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(back[k], values[k], 0.5e-4 + 1e-9);
  }
}

TEST(Series, OfWhatStandsStillAreShort) { EXPECT_LT(series(std::vector<double>(10000, 0.7), 1e-5).dump().size(), 60u); }

TEST(Template, NamesBecomeValuesAndValuesAreNotLookedAtAgain) {
  EXPECT_EQ(filled("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
  EXPECT_THROW(filled("{{nobody}}", {}), std::logic_error);
}

TEST(Triangles, SurfacesAreClosedAndPointOutwards) {
  for (const Shape& shape : {Shape(Box{{0.1, 0.2, 0.3}}), Shape(Cylinder{0.05, 0.2}), Shape(Sphere{0.1})}) {
    const TriangleMesh mesh = tessellate(shape, 64);
    double six_volumes = 0;  // by the divergence theorem
    for (const auto& [a, b, c] : mesh.triangles)
      six_volumes += mesh.vertices[static_cast<std::size_t>(a)].dot(
          mesh.vertices[static_cast<std::size_t>(b)].cross(mesh.vertices[static_cast<std::size_t>(c)]));
    EXPECT_NEAR(six_volumes / 6 / volume(shape), 1, 0.01) << describe(shape);
  }
}

TEST(Triangles, ReducingKeepsTheShapeAndTheBudget) {
  const TriangleMesh fine = tessellate(Sphere{0.1}, 200);
  ASSERT_GT(fine.triangles.size(), 10000u);
  const TriangleMesh coarse = reduce(fine, 600);
  EXPECT_LE(coarse.triangles.size(), 600u);
  EXPECT_GT(coarse.triangles.size(), 100u);
  for (const Eigen::Vector3d& p : coarse.vertices) EXPECT_NEAR(p.norm(), 0.1, 0.02);
}

class Page : public testing::Test {
 protected:
  Page() {
    problem.scene.objects.push_back(can_at("can </script>", -0.2));
    result.plan = sweep(problem, {0.2});
    result.planner = "by hand";
    StopSource stop;
    verdict = Verifier().judge(problem, result.plan, stop, recording);
  }
  Playback everything() const { return {&problem, &result, &recording, &verdict}; }

  Problem problem = table_problem();
  PlanResult result;
  Recording recording;
  Verdict verdict;
};

TEST_F(Page, IsOneFileWithoutLinksOutside) {
  const std::string page = playback_page(everything());
  EXPECT_LT(page.size(), 2'000'000u);
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "fetch(\"", "</script>\"", "<link rel=\"style"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_THAT(page, HasSubstr("can \\u003c/script>"));
  EXPECT_EQ(page, playback_page(everything()));
}

TEST_F(Page, ShowsAProblemAloneAndARunWithoutAPlan) {
  EXPECT_THAT(playback_page({&problem, nullptr, nullptr, nullptr}), HasSubstr("\"kind\":\"problem\""));
  PlanResult none;
  none.status = PlanStatus::limit;
  none.reason = "the lattice is exhausted";
  const std::string page = playback_page({&problem, &none, nullptr, nullptr});
  EXPECT_THAT(page, HasSubstr("\"kind\":\"failed\""));
  EXPECT_THAT(page, HasSubstr("the lattice is exhausted"));
}

TEST_F(Page, PicturesChangeWithTheTime) {
  ImageOptions options;
  options.width = 160;
  options.height = 120;
  const auto start = playback_image(everything(), options);
  options.time_s = recording.duration_s();
  const auto end = playback_image(everything(), options);
  ASSERT_TRUE(start.ok() && end.ok());
  EXPECT_NE(*start, *end);
  options.time_s = 1e9;  // clamped
  EXPECT_EQ(*playback_image(everything(), options), *end);
}

}  // namespace
}  // namespace mamo::view
