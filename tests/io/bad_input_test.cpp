// Every bad file is refused with one line that names the place and what is wrong.
#include <gmock/gmock.h>

#include <filesystem>

#include "mamo/io/load.hpp"
#include "support/bad_inputs.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

using test::BadInput;

std::string name_of(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }

void expect_one_clear_line(const Error& error, const std::string& path, const BadInput& input) {
  EXPECT_EQ(error.kind, ErrorKind::invalid_input);
  EXPECT_THAT(error.message, ::testing::StartsWith(path + ":"));
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
  EXPECT_LT(error.message.size(), 700u) << error.message;
  for (const std::string& words : input.expected) EXPECT_THAT(error.message, ::testing::HasSubstr(words));
}

class BadProblem : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadProblem, IsRefusedWithPlaceAndReason) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("p.yaml", GetParam().content);
  const Result<Problem> problem = io::load_problem(path);
  ASSERT_FALSE(problem) << "accepted";
  expect_one_clear_line(problem.error(), path, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Native, BadProblem, ::testing::ValuesIn(test::bad_problems()), name_of);
INSTANTIATE_TEST_SUITE_P(Shelf, BadProblem, ::testing::ValuesIn(test::bad_shelf_scenes()), name_of);

class BadPlan : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadPlan, IsRefusedWithPlaceAndReason) {
  const test::ScratchFolder folder;
  const Result<Problem> problem = io::load_problem(folder.write("p.yaml", test::good_problem()));
  ASSERT_TRUE(problem) << problem.error().message;
  const std::string path = folder.write("plan.json", GetParam().content);
  const Result<Plan> plan = io::load_plan(path, *problem);
  ASSERT_FALSE(plan) << "accepted";
  expect_one_clear_line(plan.error(), path, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Json, BadPlan, ::testing::ValuesIn(test::bad_plans()), name_of);

TEST(BadFile, MissingFolderAndHugeFilesAreNamed) {
  const test::ScratchFolder folder;
  const std::string missing = folder.path() + "/none.yaml";
  EXPECT_THAT(io::load_problem(missing).error().message, ::testing::HasSubstr(missing + ": cannot be read: No such file"));
  EXPECT_THAT(io::load_problem(folder.path()).error().message, ::testing::HasSubstr("is a folder"));
  const std::string huge = folder.write("huge.yaml", "x");
  std::filesystem::resize_file(huge, 1ull << 33);
  EXPECT_THAT(io::load_problem(huge).error().message, ::testing::HasSubstr("too large"));
  EXPECT_THAT(io::load_problem("/dev/zero").error().message, ::testing::HasSubstr("too large"));
  EXPECT_FALSE(io::load_problem(""));
}

TEST(BadFile, TheGoodFilesTheBadOnesAreMadeFromLoad) {
  const test::ScratchFolder folder;
  const Result<Problem> native = io::load_problem(folder.write("p.yaml", test::good_problem()));
  EXPECT_TRUE(native) << native.error().message;
  const Result<Problem> shelf = io::load_problem(folder.write("p.txt", test::good_shelf_scene()));
  EXPECT_TRUE(shelf) << shelf.error().message;
}

}  // namespace
}  // namespace mamo
