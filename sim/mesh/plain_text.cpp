#include "sim/mesh/plain_text.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace gnbv {
namespace {

/// Whether a well-formed number far from 1 is below it: looks at the power of ten of its first
/// digit that is not 0.
bool is_below_one(std::string_view word) {
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

void split(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view kBlanks = " \t\r";
  words.clear();
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return;
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(words.back().size());
  }
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
  const double size = is_below_one(word) ? 0.0 : std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -size : size;
}

}  // namespace gnbv
