// XML text that may be looked into safely: parsed, without DOCTYPE, every problem with its file and line.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mamo/common/result.hpp"

namespace mamo::io {

struct XmlFile {
  std::string path;
  std::string text;
  std::unique_ptr<tinyxml2::XMLDocument> document;  // parsed from `text`; owns the elements
  tinyxml2::XMLElement* root = nullptr;

  /// "path:line: message"
  Error error_at(const tinyxml2::XMLElement* element, const std::string& message) const;
};

/// Reads and parses a file whose root element must be called `root_name`. Refuses what is not text, a DOCTYPE
/// (entities could expand without end) and, by tinyxml2, elements nested deeper than 100.
Result<XmlFile> load_xml(const std::string& path, const std::string& root_name, std::size_t max_bytes = 16u << 20);

/// Exactly `count` finite numbers separated by white space, whatever the locale.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

/// The attribute, "" when absent.
std::string attribute(const tinyxml2::XMLElement* element, const char* name);

}  // namespace mamo::io
