// What is wrong with a scenario, and where it says so. Errors are collected, then thrown together.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/error.hpp"

namespace gnbv {

/// Where a value was given: a line of a file, or an override.
struct SourceLocation {
  std::string source;  // as the message shows it: a path, "--set a.b=c"
  int line = 0;        // from 1; 0 = the source has no lines
  int rank = 0;        // 0 the file, then 1, 2, ... the overrides: later ones win

  std::pair<int, int> order() const { return {rank, line}; }
};

/// "source:line", or "source".
std::string text_of(const SourceLocation& location);

/// By the path of a key ("cameras.0.name"): where its value was last given.
using SourceLocations = std::map<std::string, SourceLocation>;

/// Parts that are empty do not apply.
struct ValidationError {
  SourceLocation location;
  std::string key;
  std::string value;
  std::string what;
};

/// All that is wrong with a scenario, as text and as a list.
class BadScenario : public BadInput {
 public:
  BadScenario(const std::string& text, std::vector<ValidationError> all)
      : BadInput(text), errors(std::move(all)) {}
  std::vector<ValidationError> errors;
};

class ValidationErrors {
 public:
  void add(const SourceLocation& location, std::string_view key, std::string_view value,
           std::string_view what);

  bool empty() const { return errors_.empty(); }
  /// Whether the key, one above or one below it is wrong.
  bool concerns(std::string_view path) const;
  /// Throws BadScenario with a line for each error, "source:line: key: value 'value': what", in the
  /// order of the input; returns if there are none.
  void throw_if_any() const;

 private:
  std::vector<ValidationError> errors_;
};

/// Whether one path equals the other or lies below it.
bool is_at_or_below(std::string_view path, std::string_view above);

/// Number of single-character insertions, deletions and replacements that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name with the smallest edit distance, of several the first; nothing when all are
/// farther than half the name's length, or 2 if that is more.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> known);

/// "did you mean 'isler'? " where the name may be a misspelt known one, else empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

/// "a, b, c".
std::string join(std::span<const std::string_view> names);

}  // namespace gnbv
