// Seeded mutations of good files: whatever comes, a reader answers with a value or with one clear line.
#include "support/bad_inputs.hpp"
#include "support/sample_problem.hpp"
#include "support/scratch_folder.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/result_json.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 20;

/// One to four bytes changed, dropped, doubled or taken from elsewhere in the text.
std::string mutated(std::string text, RandomStream& random) {
  static const std::string kBytes = "{}[]:,-#&*!|>'\"%@?~ \n\t.0123456789eaN\\\x01\xff";
  const auto place = [&] { return static_cast<std::size_t>(random.below(text.size())); };
  for (std::uint64_t n = 1 + random.below(4); n > 0 && text.size() > 4; --n) {
    switch (random.below(5)) {
      case 0:
        text[place()] = kBytes[random.below(kBytes.size())];
        break;
      case 1:
        text.erase(place(), 1 + random.below(20));
        break;
      case 2:
        text.insert(place(), 1, kBytes[random.below(kBytes.size())]);
        break;
      case 3:
        text.insert(place(), text.substr(place(), 1 + random.below(40)));
        break;
      case 4:
        if (random.below(4) == 0) text.resize(1 + place());
        break;
    }
  }
  return text;
}

template <class Load>
void expect_values_or_clear_lines(const std::string& good, int rounds, const Load& load) {
  int refused = 0;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " round " + std::to_string(i));
    RandomStream random(kSeed, {static_cast<std::uint64_t>(i)});
    const std::string text = mutated(good, random);
    const auto result = load(text, "f" + std::to_string(i));  // a new file each: replacing one may wait for the disk
    if (result) continue;
    ++refused;
    EXPECT_FALSE(result.error().message.empty()) << text;
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << text;
    EXPECT_EQ(result.error().kind, ErrorKind::invalid_input) << text;
  }
  EXPECT_GT(refused, rounds / 4) << "the mutations are too tame to test anything";
}

TEST(Mutation, OfANativeProblem) {
  const test::ScratchFolder folder;
  expect_values_or_clear_lines(
      test::good_problem() + "generated: {seed: 1}\nend: true\n", 1000,
      [&](const std::string& text, const std::string& name) { return io::load_problem(folder.write(name, text)); });
}

TEST(Mutation, OfAShelfScene) {
  const test::ScratchFolder folder;
  expect_values_or_clear_lines(test::good_shelf_scene(), 1000, [&](const std::string& text, const std::string& name) {
    return io::load_problem(folder.write(name, text));
  });
}

TEST(Mutation, OfAPlan) {
  const test::ScratchFolder folder;
  const Problem problem = fixtures::sample_problem();
  expect_values_or_clear_lines(io::plan_json(fixtures::sample_plan(problem), problem.scene), 3000,
                               [&](const std::string& text, const std::string& name) {
                                 return io::load_plan(folder.write(name, text), problem);
                               });
}

}  // namespace
}  // namespace mamo
