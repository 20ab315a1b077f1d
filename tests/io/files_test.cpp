// Whole files in and out, and where relative paths are looked up.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/sha256.hpp"
#include "io/text.hpp"
#include "mamo/io/load.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

TEST(Files, WhatIsWrittenIsReadBackAndNothingElseIsLeft) {
  const test::ScratchFolder folder;
  const std::string path = folder.path() + "/out.json", bytes("a\0b\n", 4);
  ASSERT_TRUE(io::write_file(path, bytes));
  EXPECT_EQ(io::read_file(path).value(), bytes);
  ASSERT_TRUE(io::write_file(path, "shorter"));
  EXPECT_EQ(io::read_file(path).value(), "shorter");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(Files, CheckWritableLeavesNothingBehindAndTouchesNothing) {
  const test::ScratchFolder folder;
  EXPECT_TRUE(io::check_writable(folder.path() + "/new"));
  EXPECT_EQ(files_in(folder.path()), 0u);
  const std::string old = folder.write("old", "content");
  EXPECT_TRUE(io::check_writable(old));
  EXPECT_EQ(io::read_file(old).value(), "content");
}

TEST(Files, AnUnwritableOutputIsAnErrorOfKindOutput) {
  const test::ScratchFolder folder;
  for (const std::string& path : {folder.path() + "/no/such/folder/out", folder.path(), std::string("/proc/mamo.json"), std::string()}) {
    const Status checked = io::check_writable(path), written = io::write_file(path, "x");
    ASSERT_FALSE(checked) << path;
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(checked.error().kind, ErrorKind::output);
    EXPECT_EQ(written.error().kind, ErrorKind::output);
    EXPECT_EQ(checked.error().message.find('\n'), std::string::npos);
  }
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(Files, AFullDiskLeavesNoPartialFile) {
  EXPECT_FALSE(io::write_file("/dev/full", "x"));
}

TEST(Files, DevicesAreWrittenInPlaceAndLinksKept) {
  EXPECT_TRUE(io::write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const test::ScratchFolder folder;
  const std::string real = folder.write("real", "old"), link = folder.path() + "/link";
  fs::create_symlink(real, link);
  ASSERT_TRUE(io::write_file(link, "new"));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(io::read_file(real).value(), "new");
}

TEST(Files, ReadingStopsAtTheLimit) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("ten", "0123456789");
  EXPECT_TRUE(io::read_file(path, 10));
  EXPECT_THAT(io::read_file(path, 9).error().message, HasSubstr("too large"));
  EXPECT_THAT(io::read_file("/dev/zero", 1000).error().message, HasSubstr("too large"));
}

TEST(Files, DataIsLookedUpBesideTheFileThenInTheDataFolders) {
  const test::ScratchFolder folder;
  const std::string problem = folder.write("a/p.yaml", ""), beside = folder.write("a/m.obj", "1");
  const std::string data = folder.write("data/m.obj", "2"), only_data = folder.write("data/n.obj", "3");
  ASSERT_EQ(::setenv("MAMO_DATA_DIR", (folder.path() + "/data").c_str(), 1), 0);
  EXPECT_EQ(io::find_data_file("m.obj", problem).value(), beside);
  EXPECT_EQ(io::find_data_file("n.obj", problem).value(), only_data);
  EXPECT_EQ(io::find_data_file("m.obj", "").value(), data);
  ::unsetenv("MAMO_DATA_DIR");
  EXPECT_EQ(io::find_data_file(data, problem).value(), data) << "absolute paths are what they are";
  EXPECT_TRUE(io::find_data_file("robots/pr2_right_arm.urdf", problem)) << "bench/data of the source tree";
  const auto missing = io::find_data_file("n.obj", problem);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr(folder.path() + "/a/n.obj"));
  EXPECT_THAT(missing.error().message, HasSubstr("share/mamo"));
}

TEST(Files, Sha256AgreesWithThePublishedVectors) {
  EXPECT_EQ(io::sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(io::sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Text, NumbersReadBackAsTheSameDoubleAndLookLikeNumbersToYaml) {
  for (double v : {0.1, 1.0 / 3.0, 1e-5, 1e22, -2.5e-300, 5e-324, 0.0, 1.7976931348623157e308, 120.0}) {
    EXPECT_EQ(io::parse_number(io::yaml_number(v)), v);
    EXPECT_NE(io::yaml_number(v).find('.'), std::string::npos);
  }
  EXPECT_EQ(io::parse_number("+1.5"), 1.5);
  EXPECT_TRUE(std::isinf(*io::parse_number("-.inf")));
  EXPECT_TRUE(std::isnan(*io::parse_number(".NaN")));
  for (const char* text : {"", "+", "-", "1.5m", "1,5", " 1", "--1", "+-1", "0x10"})
    EXPECT_FALSE(io::parse_number(text)) << text;
}

TEST(Text, MessagesStayOnOneLine) {
  EXPECT_EQ(io::in_quotes("a\nb\x1b[31m"), "'a b\\x1b[31m'");
  EXPECT_LE(io::in_quotes(std::string(1000, 'x')).size(), 66u);
}

}  // namespace
}  // namespace mamo
