// A YAML text as a tree that remembers where everything was written. The only file of the project
// that knows yaml-cpp is its .cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/validation_error.hpp"

namespace gnbv {

struct YamlEntry;

struct YamlNode {
  /// picks: made by the dotted path of an override, `a.0.b=c`; its entries are keys of a map or
  /// indices into a list, and everything not named keeps its value.
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
/// `errors`; nothing is returned when there is no tree to go on with (syntax error, empty text).
std::optional<YamlNode> parse_document(const std::string& text, const SourceLocation& source,
                                       ValidationErrors& errors);

/// Reads "a.b.c=value" (the value is YAML) as a tree of picks. `location` has no line; its rank is
/// the place among the overrides, from 1.
std::optional<YamlNode> parse_override(const std::string& text, const SourceLocation& location,
                                       ValidationErrors& errors);

}  // namespace gnbv
