// A YAML text as a tree that remembers where everything was written, and back as text. Only its
// .cpp knows yaml-cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/validation_error.hpp"

namespace gnbv {

struct YamlEntry;

struct YamlNode {
  /// picks: made by the dotted path of an override, `a.0.b=c`. Its entries are keys of a map or
  /// indices into a list; whatever they do not name keeps its value.
  enum class Kind { null, scalar, list, map, picks };

  Kind kind = Kind::null;
  std::string text;                // scalar
  bool is_quoted = false;          // scalar: always text, never a number or a bool
  std::vector<YamlNode> items;     // list
  std::vector<YamlEntry> entries;  // map, picks; keys differ, in the order given
  SourceLocation location;

  /// The value of a key; null pointer when it is not there.
  const YamlNode* find(std::string_view key) const;
};

struct YamlEntry {
  std::string key;
  SourceLocation location;
  YamlNode value;
};

/// Reads exactly one document. Syntax errors, duplicate keys, tags and further documents go to
/// `errors`. Returns nothing when there is no tree to go on with (syntax error, empty text).
std::optional<YamlNode> parse_document(const std::string& text, const SourceLocation& source,
                                       ValidationErrors& errors);

/// Reads "a.b.c=value" (the value is YAML) as a tree of picks. `location` has no line; its rank is
/// the place among the overrides, from 1.
std::optional<YamlNode> parse_override(const std::string& text, const SourceLocation& location,
                                       ValidationErrors& errors);

/// The value as YAML in flow style, on one line, which parse_override() reads as the same value.
std::string flow_yaml(const YamlNode& node);

/// The value as a message shows it; long ones are cut.
std::string excerpt(const YamlNode& node);

/// The text as a double-quoted scalar.
std::string yaml_in_quotes(const std::string& text);

}  // namespace gnbv
