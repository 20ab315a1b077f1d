// Strict YAML: a tree of values that know their place in the file. Refused: anchors, aliases, tags, several
// documents, nesting deeper than 64, the same key twice, keys that are no scalars, more than a million values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mamo/common/result.hpp"

namespace mamo::io {

inline constexpr int kMaxYamlDepth = 64;
inline constexpr std::size_t kMaxYamlValues = 1000000;

struct YamlMember;

/// A scalar, a list or a map. Values are kept as text: the reader decides what they mean.
struct YamlValue {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  std::string scalar;
  bool quoted = false;  // 'true' in quotes is text, never a truth value
  std::vector<YamlValue> items;
  std::vector<YamlMember> members;  // in file order
  int line = 0, column = 0;         // 1-based

  bool is_map() const { return kind == Kind::map; }
  bool is_list() const { return kind == Kind::list; }
  bool is_scalar() const { return kind == Kind::scalar; }
  /// Null when there is no such key.
  const YamlValue* find(std::string_view key) const;
};

struct YamlMember {
  std::string key;
  int line = 0, column = 0;
  YamlValue value;
};

/// `file` stands in messages only. An empty document is an error.
Result<YamlValue> parse_yaml(const std::string& text, const std::string& file);

}  // namespace mamo::io
