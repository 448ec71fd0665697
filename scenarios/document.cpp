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

/// Turns yaml-cpp's events into a tree. Its own YAML::Node would lose duplicate keys.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(Origin source, Faults& faults) : source_(std::move(source)), faults_(faults) {}

  YamlNode& root() { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode node;
    node.origin = at(mark);
    finish(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = anchors_.find(anchor);
    if (known == anchors_.end()) {
      faults_.add(at(mark), path(), "", "the alias stands inside the value it refers to");
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
    node.origin = at(mark);
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

  Origin at(const YAML::Mark& mark) const {
    return {source_.source, source_.line > 0 ? mark.line + 1 : 0, source_.rank};
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    faults_.add(at(mark), path(), "", fmt::format("the tag '{}' is not supported", tag));
  }

  void begin(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
             YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    Open open;
    open.node.kind = kind;
    open.node.origin = at(mark);
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
      mark.line = std::max(0, node.origin.line - 1);
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
      faults_.add(key.origin, path(), excerpt(key), "a key has to be a word");
      map.is_dropped = true;
    }
    map.key = {key.text, key.origin, {}};
    map.has_key = true;
    for (const YamlEntry& entry : map.node.entries) {
      if (entry.key != key.text) continue;
      const Origin& first = entry.origin;
      faults_.add(key.origin, path(), "",
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

  Origin source_;
  Faults& faults_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
  std::size_t copied_nodes_ = 0;
};

/// Only tells where a further document begins.
class SecondDocument final : public YAML::EventHandler {
 public:
  int line = 1;

 private:
  void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const YamlEntry& e) { return e.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

std::optional<YamlNode> parse_document(const std::string& text, const Origin& source,
                                       Faults& faults) {
  std::istringstream stream(text);
  TreeBuilder builder(source, faults);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      faults.add(source, "", "", "is empty; a scenario is a map of keys");
      return std::nullopt;
    }
    SecondDocument second;
    if (parser.HandleNextDocument(second)) {
      faults.add({source.source, source.line > 0 ? second.line : 0, source.rank}, "", "",
                 "a second YAML document begins here; a scenario is one document");
    }
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 1 : error.mark.line + 1;
    faults.add({source.source, source.line > 0 ? line : 0, source.rank}, "", "",
               fmt::format("not YAML: {}", error.msg));
    return std::nullopt;
  }
  return std::move(builder.root());
}

std::optional<YamlNode> parse_override(const std::string& text, const Origin& origin,
                                       Faults& faults) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    faults.add(origin, "", "", "has to read key=value, as in planner.agvs.step_m=0.5");
    return std::nullopt;
  }
  std::optional<YamlNode> value;
  if (text.find_first_not_of(" \t\n", equals + 1) == std::string::npos) {
    value = YamlNode{};  // `key=` gives the key no value, which the reader names
    value->origin = origin;
  } else {
    value = parse_document(text.substr(equals + 1), origin, faults);
  }
  if (!value) return std::nullopt;
  std::string path = text.substr(0, equals);
  YamlNode node = std::move(*value);
  while (true) {
    const std::size_t dot = path.rfind('.');
    YamlNode parent;
    parent.kind = YamlNode::Kind::picks;
    parent.origin = origin;
    parent.entries.push_back(
        {dot == std::string::npos ? path : path.substr(dot + 1), origin, std::move(node)});
    node = std::move(parent);
    if (dot == std::string::npos) return node;
    path.resize(dot);
  }
}

}  // namespace gnbv
