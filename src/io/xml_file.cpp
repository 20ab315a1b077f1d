#include "io/xml_file.hpp"

#include <charconv>

#include "mamo/io/load.hpp"

namespace mamo::io {
namespace {

bool looks_like_text(const std::string& text) { return text.find('\0') == std::string::npos; }

/// tinyxml2 keeps a DOCTYPE as an "unknown" node: `<!` that is neither comment nor CDATA.
const tinyxml2::XMLNode* find_doctype(const tinyxml2::XMLDocument& document) {
  for (const tinyxml2::XMLNode* node = document.FirstChild(); node; node = node->NextSibling())
    if (node->ToUnknown()) return node;
  return nullptr;
}

/// tinyxml2's ErrorStr is "Error=NAME ErrorID=.. Line number=..: detail": keep the name.
std::string reason_of(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "empty document";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is never closed, or closed out of order";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "malformed attribute";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply (limit 100)";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "malformed element";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "malformed text";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "comment without end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "CDATA section without end";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "malformed declaration";
    case tinyxml2::XML_ERROR_PARSING:
      return "unexpected end or element never closed";
    default:
      return document.ErrorName();
  }
}

}  // namespace

Error XmlFile::error_at(const tinyxml2::XMLElement* element, const std::string& message) const {
  return {path + ":" + std::to_string(element->GetLineNum()) + ": " + message, ErrorKind::invalid_input};
}

Result<XmlFile> load_xml(const std::string& path, const std::string& root_name, std::size_t max_bytes) {
  Result<std::string> text = read_file(path, max_bytes);
  if (!text) return text.error();
  if (text->empty()) return Error{path + ": empty file, expected XML with <" + root_name + ">"};
  if (!looks_like_text(*text)) return Error{path + ": binary file, expected XML with <" + root_name + ">"};

  XmlFile file;
  file.path = path;
  file.text = std::move(*text);
  file.document = std::make_unique<tinyxml2::XMLDocument>();
  if (file.document->Parse(file.text.data(), file.text.size()) != tinyxml2::XML_SUCCESS)
    return Error{path + ":" + std::to_string(std::max(1, file.document->ErrorLineNum())) +
                 ": not well-formed XML: " + reason_of(*file.document)};
  if (const tinyxml2::XMLNode* doctype = find_doctype(*file.document))
    return Error{path + ":" + std::to_string(doctype->GetLineNum()) +
                 ": DOCTYPE and entity declarations are not accepted"};
  file.root = file.document->RootElement();
  if (!file.root) return Error{path + ": no element, expected <" + root_name + ">"};
  if (file.root->Name() != root_name)
    return file.error_at(file.root,
                         "root element is <" + std::string(file.root->Name()) + ">, expected <" + root_name + ">");
  return file;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (true) {
    while (at != end && is_space(*at)) ++at;
    if (at == end) break;
    if (*at == '+' && at + 1 != end && at[1] != '-' && at[1] != '+') ++at;  // from_chars takes no plus sign
    double value = 0;
    const auto [rest, failure] = std::from_chars(at, end, value);
    if (failure != std::errc{} || !std::isfinite(value) || (rest != end && !is_space(*rest))) return std::nullopt;
    if (numbers.size() == count) return std::nullopt;
    numbers.push_back(value);
    at = rest;
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

std::string attribute(const tinyxml2::XMLElement* element, const char* name) {
  const char* value = element->Attribute(name);
  return value ? value : "";
}

}  // namespace mamo::io
