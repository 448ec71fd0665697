#include "scenarios/flow_yaml.hpp"

#include <fmt/format.h>

namespace gnbv {

std::string yaml_in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return out + '"';
}

namespace {

/// Inside a list or map: text that would end there goes into quotes; it is no number anyway.
std::string inner_text(const std::string& text) {
  return text.find_first_of(",[]{}:#\"'\n") == std::string::npos ? text : yaml_in_quotes(text);
}

std::string inner_yaml(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return "~";
  if (node.kind == YamlNode::Kind::scalar && !node.is_quoted) return inner_text(node.text);
  return flow_yaml(node);
}

}  // namespace

std::string flow_yaml(const YamlNode& node) {
  std::string text;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "";
    case YamlNode::Kind::scalar:
      return node.is_quoted ? yaml_in_quotes(node.text) : node.text;
    case YamlNode::Kind::list:
      for (const YamlNode& item : node.items) text += (text.empty() ? "" : ", ") + inner_yaml(item);
      return '[' + text + ']';
    case YamlNode::Kind::map:
    case YamlNode::Kind::picks:
      for (const YamlEntry& entry : node.entries) {
        text += (text.empty() ? "" : ", ") + inner_text(entry.key) + ": " + inner_yaml(entry.value);
      }
      return '{' + text + '}';
  }
  return text;
}

std::string excerpt(const YamlNode& node) {
  constexpr std::size_t kMaxLength = 60;
  std::string text = flow_yaml(node);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (text.size() <= kMaxLength) return text;
  std::size_t end = kMaxLength - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) --end;  // whole UTF-8
  return text.substr(0, end) + "...";
}

}  // namespace gnbv
