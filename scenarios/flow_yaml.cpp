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

/// Appends the value; no further than a little beyond `most` characters.
void put_flow(const YamlNode& node, bool is_inside, std::size_t most, std::string& text) {
  const bool is_list = node.kind == YamlNode::Kind::list;
  switch (node.kind) {
    case YamlNode::Kind::null:
      if (is_inside) text += '~';
      return;
    case YamlNode::Kind::scalar:
      if (node.is_quoted) {
        text += yaml_in_quotes(node.text);
      } else {
        text += is_inside ? inner_text(node.text) : node.text;
      }
      return;
    case YamlNode::Kind::list:
    case YamlNode::Kind::map:
    case YamlNode::Kind::picks:
      break;
  }
  text += is_list ? '[' : '{';
  const std::size_t begin = text.size();
  for (const YamlNode& item : node.items) {
    if (text.size() > most) break;
    if (text.size() > begin) text += ", ";
    put_flow(item, true, most, text);
  }
  for (const YamlEntry& entry : node.entries) {
    if (text.size() > most) break;
    if (text.size() > begin) text += ", ";
    text += inner_text(entry.key) + ": ";
    put_flow(entry.value, true, most, text);
  }
  text += is_list ? ']' : '}';
}

}  // namespace

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

}  // namespace gnbv
