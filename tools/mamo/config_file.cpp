#include "config_file.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "console.hpp"

#include "mamo/io/load.hpp"

namespace mamo::tool {
namespace {

/// Thrown by the handler, caught in read_config: yaml-cpp offers no other way out of a parse.
struct Refused {
  YAML::Mark mark;
  std::string text;
};

/// Builds the list straight from parser events, so that nothing nested or aliased is ever expanded.
class FlatMap final : public YAML::EventHandler {
 public:
  explicit FlatMap(std::string path) : path_(std::move(path)) {}
  std::vector<ConfigEntry> entries;

  std::string place(const YAML::Mark& mark) const {
    return format("%s:%d:%d", path_.c_str(), mark.line + 1, mark.column + 1);
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (in_map_) OnScalar(mark, "", anchor, "");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { throw Refused{mark, "aliases are not allowed"}; }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string& value) override {
    if (anchor) throw Refused{mark, "anchors are not allowed"};
    if (!in_map_) throw Refused{mark, "expected `option: value` lines"};
    if (!key_) {
      for (const ConfigEntry& entry : entries)
        if (entry.key == value) throw Refused{mark, "option '" + value + "' is given twice"};
      entries.push_back({value, "", ""});
    } else {
      if (value.empty()) throw Refused{mark, "option '" + entries.back().key + "' has no value"};
      entries.back().value = value;
      entries.back().place = place(mark);
    }
    key_ = !key_;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    throw Refused{mark, "expected one value, not a list"};
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    if (in_map_) throw Refused{mark, "expected one value, not a mapping"};
    in_map_ = true;
  }
  void OnMapEnd() override {}

 private:
  std::string path_;
  bool in_map_ = false, key_ = false;
};

}  // namespace

Result<std::vector<ConfigEntry>> read_config(const std::string& path) {
  const Result<std::string> text = io::read_file(path, 1u << 20);
  if (!text.ok()) return text.error();
  FlatMap handler(path);
  try {
    std::istringstream stream(*text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(handler);
  } catch (const Refused& refused) {
    return Error{handler.place(refused.mark) + ": " + refused.text};
  } catch (const YAML::Exception& error) {
    return Error{handler.place(error.mark) + ": " + error.msg};
  }
  return handler.entries;
}

}  // namespace mamo::tool
