#include "mamo/io/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <set>
#include <sstream>

#include "io/text.hpp"

namespace mamo::io {
namespace {

/// Leaves the parser through yaml-cpp, which knows exceptions only; caught in parse_yaml.
struct Refused {
  int line, column;  // 1-based
  std::string message;
  Refused(const YAML::Mark& mark, std::string text)
      : line(mark.line + 1), column(mark.column + 1), message(std::move(text)) {}
  Refused(const YamlValue& at, std::string text) : line(at.line), column(at.column), message(std::move(text)) {}
};

/// Builds the tree from the parser's events, which come before anything is expanded or recursed into.
class Builder final : public YAML::EventHandler {
 public:
  YamlValue take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string&) override {
    throw Refused{mark, "anchors (&name) are not allowed here"};
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refused{mark, "aliases (*name) are not allowed here"};
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    add(make(mark, YamlValue::Kind::null));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    refuse_anchor(mark, anchor);
    if (tag != "?" && tag != "!" && !tag.empty()) throw Refused{mark, "tags (!name) are not allowed here"};
    YamlValue value = make(mark, YamlValue::Kind::scalar);
    value.scalar = text;
    value.quoted = tag == "!";
    add(std::move(value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlValue::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlValue::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    YamlValue value;
    bool key_read = false;  // of a map: the next value belongs to members.back()
    std::set<std::string> keys;
  };

  static void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor) throw Refused{mark, "anchors (&name) are not allowed here"};
  }

  YamlValue make(const YAML::Mark& mark, YamlValue::Kind kind) {
    if (++values_ > kMaxYamlValues)
      throw Refused{mark, "more than " + std::to_string(kMaxYamlValues) + " values in one file"};
    YamlValue value;
    value.kind = kind;
    value.line = mark.line + 1;
    value.column = mark.column + 1;
    return value;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YamlValue::Kind kind) {
    refuse_anchor(mark, anchor);
    if (tag != "?" && tag != "!" && !tag.empty()) throw Refused{mark, "tags (!name) are not allowed here"};
    if (static_cast<int>(frames_.size()) >= kMaxYamlDepth)
      throw Refused{mark, "nested deeper than " + std::to_string(kMaxYamlDepth) + " levels"};
    frames_.push_back({make(mark, kind), false, {}});
  }

  void close() {
    YamlValue value = std::move(frames_.back().value);
    frames_.pop_back();
    add(std::move(value));
  }

  void add(YamlValue value) {
    if (frames_.empty()) {
      root_ = std::move(value);
      return;
    }
    Frame& frame = frames_.back();
    if (frame.value.is_list()) {
      frame.value.items.push_back(std::move(value));
    } else if (frame.key_read) {
      frame.value.members.back().value = std::move(value);
      frame.key_read = false;
    } else {
      add_key(frame, value);
    }
  }

  void add_key(Frame& frame, const YamlValue& key) {
    if (!key.is_scalar()) throw Refused{key, "a key must be a single word, not a list, a map or nothing"};
    if (!frame.keys.insert(key.scalar).second)
      throw Refused{key, "the key " + in_quotes(key.scalar) + " stands here a second time"};
    frame.value.members.push_back({key.scalar, key.line, key.column, {}});
    frame.key_read = true;
  }

  YamlValue root_;
  std::vector<Frame> frames_;
  std::size_t values_ = 0;
};

}  // namespace

const YamlValue* YamlValue::find(std::string_view key) const {
  for (const YamlMember& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

Result<YamlValue> parse_yaml(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  Builder builder;
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) return error_at(file, 0, 0, "holds no YAML value");
    YamlValue root = builder.take();
    Builder second;
    if (parser.HandleNextDocument(second)) return error_at(file, 0, 0, "holds more than one YAML document");
    return root;
  } catch (const Refused& refused) {
    return error_at(file, refused.line, refused.column, refused.message);
  } catch (const YAML::Exception& e) {
    return error_at(file, e.mark.line + 1, e.mark.column + 1, "bad YAML: " + one_line(e.msg));
  } catch (const std::exception& e) {
    return error_at(file, 0, 0, "bad YAML: " + one_line(e.what()));
  }
}

}  // namespace mamo::io
