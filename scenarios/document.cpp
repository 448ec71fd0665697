#include "scenarios/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

// Aliases can repeat aliases: a short text may ask for more copies of its values than fit into
// memory.
constexpr std::size_t kMostCopies = 100'000;

/// Turns yaml-cpp's tree into ours.
class Converter {
 public:
  /// A text has no more values than letters, but for copies.
  Converter(const std::string& text, SourceLocation source, ValidationErrors& errors)
      : most_values_(text.size() + kMostCopies), source_(std::move(source)), errors_(errors) {}

  SourceLocation at(const YAML::Mark& mark) const {
    return {source_.source, source_.line > 0 ? std::max(0, mark.line) + 1 : 0, source_.rank};
  }

  YamlNode converted(const YAML::Node& from, const std::string& path = "") {
    if (++values_ > most_values_) {
      throw YAML::ParserException(
          from.Mark(),
          fmt::format("anchors and aliases stand for more than {} values", kMostCopies));
    }
    const std::string& tag = from.Tag();
    YamlNode node;
    node.location = at(from.Mark());
    if (std::ranges::any_of(open_, [&](const YAML::Node& open) { return open.is(from); })) {
      errors_.add(node.location, path, "", "the alias stands inside the value it refers to");
      return node;
    }
    open_.push_back(from);
    // yaml-cpp: "!" for quoted and block text, "?" for plain
    if (!tag.empty() && tag != "?" && tag != "!") {
      errors_.add(node.location, path, "", fmt::format("the tag '{}' is not supported", tag));
    }
    const auto below = [&](const std::string& key) {
      return path.empty() ? key : path + '.' + key;
    };
    if (from.IsScalar()) {
      node.kind = Kind::scalar;
      node.text = from.Scalar();
      node.is_quoted = tag == "!";
    } else if (from.IsSequence()) {
      node.kind = Kind::list;
      for (const auto& item : from) {
        node.items.push_back(converted(item, below(std::to_string(node.items.size()))));
      }
    } else if (from.IsMap()) {
      node.kind = Kind::map;
      for (const auto& entry : from) {
        const YamlNode key = converted(entry.first, path);
        YamlNode value = converted(entry.second, below(key.text));
        const auto first = std::ranges::find(node.entries, key.text, &YamlEntry::key);
        if (key.kind != Kind::scalar) {
          errors_.add(key.location, path, excerpt(key), "a key has to be a word");
        } else if (first != node.entries.end()) {
          const int line = first->location.line;
          errors_.add(key.location, below(key.text), "",
                      line > 0 ? fmt::format("key given twice, first on line {}", line)
                               : "key given twice");
        } else {
          node.entries.push_back({key.text, key.location, std::move(value)});
        }
      }
    }
    open_.pop_back();
    return node;
  }

 private:
  std::size_t values_ = 0;
  std::vector<YAML::Node> open_;  // those that hold the one at hand
  std::size_t most_values_;
  SourceLocation source_;
  ValidationErrors& errors_;
};

/// Where documents begin. YAML::LoadAll() would tell no line, and takes a comma for documents
/// without end.
struct DocumentStart final : YAML::EventHandler {
  YAML::Mark last;
  void OnDocumentStart(const YAML::Mark& mark) override { last = mark; }
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

/// Inside a list or map: text that would end there goes into quotes; it is no number anyway.
std::string inner_text(const std::string& text) {
  return text.find_first_of(",[]{}:#\"'\n") == std::string::npos ? text : yaml_in_quotes(text);
}

/// Appends the value; no further than a little beyond `most` characters.
void put_flow(const YamlNode& node, bool is_inside, std::size_t most, std::string& text) {
  if (node.kind == Kind::null) {
    if (is_inside) text += '~';
    return;
  }
  if (node.kind == Kind::scalar) {
    const std::string plain = is_inside ? inner_text(node.text) : node.text;
    text += node.is_quoted ? yaml_in_quotes(node.text) : plain;
    return;
  }
  const bool is_list = node.kind == Kind::list;
  text += is_list ? '[' : '{';
  const std::size_t begin = text.size();
  const auto put = [&](const std::string& key, const YamlNode& value) {
    if (text.size() > most) return;
    if (text.size() > begin) text += ", ";
    text += key;
    put_flow(value, true, most, text);
  };
  for (const YamlNode& item : node.items) put("", item);
  for (const YamlEntry& entry : node.entries) put(inner_text(entry.key) + ": ", entry.value);
  text += is_list ? ']' : '}';
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto entry = std::ranges::find(entries, key, &YamlEntry::key);
  return entry == entries.end() ? nullptr : &entry->value;
}

std::optional<YamlNode> parse_document(const std::string& text, const SourceLocation& source,
                                       ValidationErrors& errors) {
  Converter converter(text, source, errors);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    DocumentStart start;
    if (!parser.HandleNextDocument(start)) {
      errors.add(source, "", "", "is empty; a scenario is a map of keys");
      return std::nullopt;
    }
    if (parser.HandleNextDocument(start)) {
      errors.add(converter.at(start.last), "", "",
                 "a second YAML document begins here; a scenario is one document");
    }
    return converter.converted(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    errors.add(converter.at(error.mark), "", "", fmt::format("not YAML: {}", error.msg));
    return std::nullopt;
  }
}

std::optional<YamlNode> parse_override(const std::string& text, const SourceLocation& location,
                                       ValidationErrors& errors) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    errors.add(location, "", "", "has to read key=value, as in planner.agvs.step_m=0.5");
    return std::nullopt;
  }
  std::optional<YamlNode> node = YamlNode{};
  node->location = location;
  // `key=` and `key=#comment` give the key no value, which the reader names
  const std::size_t value = text.find_first_not_of(" \t\n", equals + 1);
  if (value != std::string::npos && text[value] != '#') {
    node = parse_document(text.substr(equals + 1), location, errors);
  }
  if (!node) return std::nullopt;
  for (std::string path = text.substr(0, equals);;) {
    const std::size_t dot = path.rfind('.');
    YamlNode above;
    above.kind = Kind::picks;
    above.location = location;
    above.entries.push_back({path.substr(dot + 1), location, std::move(*node)});  // npos + 1 = 0
    node = std::move(above);
    if (dot == std::string::npos) return node;
    path.resize(dot);
  }
}

std::string flow_yaml(const YamlNode& node) {
  std::string text;
  put_flow(node, false, std::string::npos, text);
  return text;
}

std::string excerpt(const YamlNode& node) {
  constexpr std::size_t kMaxLength = 60;
  std::string text;
  put_flow(node, false, kMaxLength, text);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (text.size() <= kMaxLength) return text;
  std::size_t end = kMaxLength - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) --end;  // whole UTF-8
  return text.substr(0, end) + "...";
}

std::string yaml_in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + '"';
}

}  // namespace gnbv
