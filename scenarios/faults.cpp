#include "scenarios/faults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "sim/core/error.hpp"

namespace gnbv {

std::string text_of(const Origin& origin) {
  return origin.line > 0 ? fmt::format("{}:{}", origin.source, origin.line) : origin.source;
}

bool is_at_or_below(std::string_view path, std::string_view above) {
  return path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '.');
}

void Faults::add(const Origin& origin, std::string_view path, std::string_view value,
                 std::string_view what) {
  std::string message = text_of(origin) + ": ";
  if (!path.empty()) message += fmt::format("{}: ", path);
  if (!value.empty()) message += fmt::format("value '{}': ", value);
  message += what;
  faults_.push_back(
      {origin,
       std::string(path),
       std::move(message),
       {origin.source, origin.line, std::string(path), std::string(value), std::string(what)}});
}

bool Faults::concerns(std::string_view path) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& fault) {
    return is_at_or_below(path, fault.path) || is_at_or_below(fault.path, path);
  });
}

void Faults::throw_if_any() const {
  if (faults_.empty()) return;
  std::vector<Fault> sorted = faults_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
    return std::tie(a.origin.rank, a.origin.line) < std::tie(b.origin.rank, b.origin.line);
  });
  std::string text;
  for (const Fault& fault : sorted) text += (text.empty() ? "" : "\n") + fault.message;
  std::vector<FaultParts> parts;
  for (const Fault& fault : sorted) parts.push_back(fault.parts);
  throw BadScenario(text, std::move(parts));
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
                                             std::span<const std::string_view> known,
                                             std::size_t limit) {
  std::optional<std::string_view> nearest;
  for (const std::string_view candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance > limit || (nearest && distance == limit)) continue;
    nearest = candidate;
    limit = distance;
  }
  return nearest;
}

std::size_t slip_limit(std::string_view name) { return std::max<std::size_t>(2, name.size() / 2); }

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const auto near = nearest_name(name, known, slip_limit(name));
  return near ? fmt::format("did you mean '{}'? ", *near) : "";
}

std::string join(std::span<const std::string_view> names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace gnbv
