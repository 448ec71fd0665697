#include "tools/run_files/separated_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

std::string to_string(const TextPlace& place) {
  return fmt::format("{}:{}", place.file.string(), place.line);
}

double to_number(std::string_view text, const TextPlace& place, std::string_view what) {
  const std::string_view t = trimmed(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
  if (error != std::errc{} || end != t.data() + t.size() || !std::isfinite(value)) {
    throw BadInput(fmt::format("{}: {} `{}` is not a number", to_string(place), what, t));
  }
  return value;
}

int to_count(std::string_view text, const TextPlace& place, std::string_view what) {
  const double value = to_number(text, place, what);
  if (value < 0.0 || value > 1e9 || value != std::floor(value)) {
    throw BadInput(fmt::format("{}: {} `{}` is not a count", to_string(place), what, text));
  }
  return static_cast<int>(value);
}

}  // namespace gnbv
