#include "scenarios/validation_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace gnbv {

std::string text_of(const SourceLocation& location) {
  return location.line > 0 ? fmt::format("{}:{}", location.source, location.line) : location.source;
}

bool is_at_or_below(std::string_view path, std::string_view above) {
  return path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '.');
}

void ValidationErrors::add(const SourceLocation& location, std::string_view key,
                           std::string_view value, std::string_view what) {
  errors_.push_back({location, std::string(key), std::string(value), std::string(what)});
}

bool ValidationErrors::concerns(std::string_view path) const {
  return std::ranges::any_of(errors_, [&](const ValidationError& error) {
    return is_at_or_below(path, error.key) || is_at_or_below(error.key, path);
  });
}

void ValidationErrors::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<ValidationError> sorted = errors_;
  std::ranges::stable_sort(sorted, {}, [](const auto& error) { return error.location.order(); });
  std::string text;
  for (const auto& [location, key, value, what] : sorted) {
    text += fmt::format("{}{}: {}{}{}", text.empty() ? "" : "\n", text_of(location),
                        key.empty() ? "" : key + ": ",
                        value.empty() ? "" : fmt::format("value '{}': ", value), what);
  }
  throw BadScenario(text, std::move(sorted));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> known) {
  const auto distance = [&](std::string_view candidate) {
    const bool begins = name.size() >= 2 && candidate.starts_with(name);
    return begins ? std::size_t{1} : edit_distance(name, candidate);
  };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  const std::size_t limit = std::max<std::size_t>(2, name.size() / 2);
  if (nearest == known.end() || distance(*nearest) > limit) return std::nullopt;
  return *nearest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const auto near = nearest_name(name, known);
  return near ? fmt::format("did you mean '{}'? ", *near) : "";
}

std::string join(std::span<const std::string_view> names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace gnbv
