#include "scenarios/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "scenarios/flow_yaml.hpp"

namespace gnbv {
namespace {

// Aliases can repeat aliases, and anchors can stand within anchors: a short text may ask for more
// copies of its values than fit into memory.
constexpr std::size_t kMaxCopiedNodes = 100'000;

std::size_t node_count(const YamlNode& node) {
  std::size_t count = 1;
  for (const YamlNode& item : node.items) count += node_count(item);
  for (const YamlEntry& entry : node.entries) count += node_count(entry.value);
  return count;
}

/// A line of the source, if it has lines.
SourceLocation at_line(const SourceLocation& source, int line) {
  return {source.source, source.line > 0 ? line : 0, source.rank};
}

/// Turns yaml-cpp's events into a tree. Its own YAML::Node would lose duplicate keys.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(SourceLocation source, ValidationErrors& errors)
      : source_(std::move(source)), errors_(errors) {}

  YamlNode& root() { return root_; }
  int start_line() const { return start_line_; }

  void OnDocumentStart(const YAML::Mark& mark) override { start_line_ = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode node;
    node.location = at(mark);
    finish(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = anchors_.find(anchor);
    if (known == anchors_.end()) {
      errors_.add(at(mark), path(), "", "the alias stands inside the value it refers to");
      return finish({}, 0);
    }
    count_copies(known->second, mark);
    finish(known->second, 0);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    YamlNode node;
    node.kind = YamlNode::Kind::scalar;
    node.text = value;
    node.is_quoted = tag == "!";  // yaml-cpp: "!" for quoted and block text, "?" for plain
    node.location = at(mark);
    finish(std::move(node), anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(YamlNode::Kind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(YamlNode::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  /// A list or map whose end has not come yet.
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;     // map: the next value belongs to `key`
    bool is_dropped = false;  // map: that value has no place to go
    YamlEntry key;
  };

  SourceLocation at(const YAML::Mark& mark) const { return at_line(source_, mark.line + 1); }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    errors_.add(at(mark), path(), "", fmt::format("the tag '{}' is not supported", tag));
  }

  void begin(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
             YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    Open open;
    open.node.kind = kind;
    open.node.location = at(mark);
    open.anchor = anchor;
    open_.push_back(std::move(open));
  }

  void end() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    finish(std::move(closed.node), closed.anchor);
  }

  void count_copies(const YamlNode& node, const YAML::Mark& mark) {
    copied_nodes_ += node_count(node);
    if (copied_nodes_ <= kMaxCopiedNodes) return;
    throw YAML::ParserException(
        mark, fmt::format("anchors and aliases stand for more than {} values", kMaxCopiedNodes));
  }

  void finish(YamlNode node, YAML::anchor_t anchor) {
    if (anchor != 0) {
      YAML::Mark mark;
      mark.line = std::max(0, node.location.line - 1);
      count_copies(node, mark);
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::list) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      begin_entry(parent, std::move(node));
    } else {
      parent.key.value = std::move(node);
      if (!parent.is_dropped) parent.node.entries.push_back(std::move(parent.key));
      parent.has_key = false;
    }
  }

  void begin_entry(Open& map, YamlNode key) {
    map.is_dropped = false;
    if (key.kind != YamlNode::Kind::scalar) {
      errors_.add(key.location, path(), excerpt(key), "a key has to be a word");
      map.is_dropped = true;
    }
    map.key = {key.text, key.location, {}};
    map.has_key = true;
    for (const YamlEntry& entry : map.node.entries) {
      if (entry.key != key.text) continue;
      const SourceLocation& first = entry.location;
      errors_.add(key.location, path(), "",
                  first.line > 0 ? fmt::format("key given twice, first on line {}", first.line)
                                 : "key given twice");
      map.is_dropped = true;
    }
  }

  /// Of the value that is being read.
  std::string path() const {
    std::string text;
    for (const Open& open : open_) {
      if (open.node.kind == YamlNode::Kind::map && !open.has_key) break;
      if (!text.empty()) text += '.';
      text += open.node.kind == YamlNode::Kind::map ? open.key.key
                                                    : std::to_string(open.node.items.size());
    }
    return text;
  }

  SourceLocation source_;
  ValidationErrors& errors_;
  int start_line_ = 1;  // of the document
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
  std::size_t copied_nodes_ = 0;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const YamlEntry& e) { return e.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

std::optional<YamlNode> parse_document(const std::string& text, const SourceLocation& source,
                                       ValidationErrors& errors) {
  std::istringstream stream(text);
  TreeBuilder builder(source, errors);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      errors.add(source, "", "", "is empty; a scenario is a map of keys");
      return std::nullopt;
    }
    ValidationErrors ignored;
    TreeBuilder second(source, ignored);
    if (parser.HandleNextDocument(second)) {
      errors.add(at_line(source, second.start_line()), "", "",
                 "a second YAML document begins here; a scenario is one document");
    }
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 1 : error.mark.line + 1;
    errors.add(at_line(source, line), "", "", fmt::format("not YAML: {}", error.msg));
    return std::nullopt;
  }
  return std::move(builder.root());
}

std::optional<YamlNode> parse_override(const std::string& text, const SourceLocation& location,
                                       ValidationErrors& errors) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    errors.add(location, "", "", "has to read key=value, as in planner.agvs.step_m=0.5");
    return std::nullopt;
  }
  std::optional<YamlNode> value;
  if (text.find_first_not_of(" \t\n", equals + 1) == std::string::npos) {
    value = YamlNode{};  // `key=` gives the key no value, which the reader names
    value->location = location;
  } else {
    value = parse_document(text.substr(equals + 1), location, errors);
  }
  if (!value) return std::nullopt;
  std::string path = text.substr(0, equals);
  YamlNode node = std::move(*value);
  while (true) {
    const std::size_t dot = path.rfind('.');
    YamlNode parent;
    parent.kind = YamlNode::Kind::picks;
    parent.location = location;
    parent.entries.push_back(
        {dot == std::string::npos ? path : path.substr(dot + 1), location, std::move(node)});
    node = std::move(parent);
    if (dot == std::string::npos) return node;
    path.resize(dot);
  }
}

}  // namespace gnbv
