#include "mamo/io/yaml_tree.hpp"

#include <gmock/gmock.h>

namespace mamo::io {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(const std::string& text) {
  const auto tree = parse_yaml(text, "f.yaml");
  return tree ? "accepted" : tree.error().message;
}

TEST(YamlTree, KeepsOrderKindsAndPlaces) {
  const auto tree = parse_yaml("b: 1\na: [x, 'true', true, ~]\nm:\n  k: {z: 2}\n", "f.yaml");
  ASSERT_TRUE(tree) << tree.error().message;
  ASSERT_EQ(tree->members.size(), 3u);
  EXPECT_EQ(tree->members[0].key, "b");
  const YamlValue& list = *tree->find("a");
  ASSERT_EQ(list.items.size(), 4u);
  EXPECT_EQ(list.line, 2);
  EXPECT_EQ(list.column, 4);
  EXPECT_TRUE(list.items[1].quoted);
  EXPECT_FALSE(list.items[2].quoted);
  EXPECT_EQ(list.items[3].kind, YamlValue::Kind::null);
  const YamlValue& z = *tree->find("m")->find("k")->find("z");
  EXPECT_EQ(z.scalar, "2");
  EXPECT_EQ(z.line, 4);
  EXPECT_EQ(tree->find("nothing"), nullptr);
}

TEST(YamlTree, AnchorsAndAliasesAreRefusedWithTheirPlace) {
  EXPECT_THAT(error_of("a: &x 1\nb: *x\n"), StartsWith("f.yaml:1:4: anchors"));
  EXPECT_THAT(error_of("a: &x [1]\n"), HasSubstr("anchors"));
  EXPECT_THAT(error_of("&x a: 1\n"), HasSubstr("anchors"));
  EXPECT_THAT(error_of("a: *x\n"), HasSubstr("f.yaml:1:"));
}

TEST(YamlTree, ABillionLaughsIsRefusedAtTheFirstAnchor) {
  std::string text = "a0: &a0 [lol, lol, lol, lol, lol, lol, lol, lol, lol]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before + ", " + before + "]\n";
  }
  EXPECT_THAT(error_of(text), StartsWith("f.yaml:1:"));
}

TEST(YamlTree, NestingUpTo64LevelsIsReadAndDeeperIsRefused) {
  EXPECT_EQ(error_of(std::string(64, '[') + std::string(64, ']')), "accepted");
  EXPECT_THAT(error_of(std::string(65, '[') + std::string(65, ']')), HasSubstr("nested deeper than 64"));
  std::string maps;
  for (int i = 0; i < 70; ++i) maps += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_THAT(error_of(maps), HasSubstr("nested deeper than 64"));
  EXPECT_THAT(error_of([] {
                std::string dashes;
                for (int i = 0; i < 5000; ++i) dashes += "- ";
                return dashes;
              }()),
              HasSubstr("nested deeper than 64"));
}

TEST(YamlTree, NestingWithoutEndIsRefusedQuickly) {
  EXPECT_THAT(error_of(std::string(2000000, '[')), HasSubstr("nested deeper than 64"));
  EXPECT_THAT(error_of(std::string(2000000, '{')), HasSubstr("f.yaml:1:"));
  EXPECT_NE(error_of(std::string(200000, '?')), "crashed");
}

TEST(YamlTree, AKeySaidTwiceIsRefused) {
  EXPECT_THAT(error_of("a: 1\nb: 2\na: 3\n"), StartsWith("f.yaml:3:1: the key 'a' stands here a second time"));
}

TEST(YamlTree, TagsDocumentsAndComplexKeysAreRefused) {
  EXPECT_THAT(error_of("a: !!python/object x\n"), HasSubstr("tags"));
  EXPECT_THAT(error_of("a: 1\n---\nb: 2\n"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(error_of("[1, 2]: 3\n"), HasSubstr("key must be a single word"));
}

TEST(YamlTree, WhatDoesNotParseHasAPlace) {
  EXPECT_THAT(error_of("a: [1, 2\nb: 3\n"), StartsWith("f.yaml:2:"));
  EXPECT_THAT(error_of("a: {b: 1"), HasSubstr("bad YAML"));
  EXPECT_THAT(error_of("\tb: 1\n a: 2\n"), StartsWith("f.yaml:"));
  EXPECT_THAT(error_of(""), HasSubstr("holds no YAML"));
}

TEST(YamlTree, TooManyValuesAreRefused) {
  std::string text = "[";
  for (int i = 0; i < 1000010; ++i) text += "1,";
  EXPECT_THAT(error_of(text + "1]"), HasSubstr("more than 1000000 values"));
}

}  // namespace
}  // namespace mamo::io
