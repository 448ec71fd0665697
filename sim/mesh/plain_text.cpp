#include "sim/mesh/plain_text.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace gnbv {
namespace {

/// Whether a well-formed number out of a double's range is too small for it, not too large: by the
/// power of ten of its first digit that is not 0.
bool is_too_small(std::string_view word) {
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  long long power = 0;
  if (e < word.size()) {
    std::string_view text = word.substr(e + 1);
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto read = std::from_chars(text.data(), text.data() + text.size(), power);
    if (read.ec == std::errc::result_out_of_range) return text.starts_with('-');
  }
  const std::string_view digits = word.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  return power + static_cast<long long>(point) < static_cast<long long>(first);
}

}  // namespace

std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
}

std::string joined(Words words) {
  return {words.front().data(), words.back().data() + words.back().size()};
}

std::optional<double> read_decimal(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0.0;
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return value;
  const double size = is_too_small(word) ? 0.0 : std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -size : size;
}

}  // namespace gnbv
