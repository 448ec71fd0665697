#include "sim/core/folding.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace gnbv {
namespace {

bool is_unit(std::string_view word) {
  constexpr std::array<std::string_view, 11> kUnits = {"m", "cm", "mm", "s",  "ms", "min",
                                                       "h", "%",  "°",  "GB", "MB"};
  while (!word.empty() && std::string_view(".,:;)").find(word.back()) != std::string_view::npos) {
    word.remove_suffix(1);
  }
  return std::find(kUnits.begin(), kUnits.end(), word) != kUnits.end();
}

std::size_t end_of_word(std::string_view text, std::size_t from = 0) {
  return std::min(text.find_first_of(" \n", from), text.size());
}

}  // namespace

std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string_view first_word(std::string_view text) {
  const std::size_t end = end_of_word(text);
  const bool is_number = end > 0 && std::isdigit(static_cast<unsigned char>(text[end - 1])) != 0;
  if (!is_number || end == text.size() || text[end] != ' ') return text.substr(0, end);
  const std::size_t next_end = end_of_word(text, end + 1);
  return text.substr(0, is_unit(text.substr(end + 1, next_end - end - 1)) ? next_end : end);
}

std::string folded_text(std::string_view text, std::size_t width) {
  if (width == 0) return std::string(text);
  std::string folded;
  std::size_t used = 0;  // of the line
  while (!text.empty()) {
    const std::string_view word = first_word(text);
    const std::size_t end = word.size();
    const bool is_first = folded.empty() || folded.back() == '\n';
    if (!is_first && used + 1 + width_of(word) > width) {
      folded += '\n';
      used = 0;
    } else if (!is_first) {
      folded += ' ';
      ++used;
    }
    folded += word;
    used += width_of(word);
    if (end < text.size() && text[end] == '\n') {
      folded += '\n';
      used = 0;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return folded;
}

std::string shortened(std::string_view text, std::size_t width) {
  if (width_of(text) <= width) return std::string(text);
  constexpr std::string_view kEllipsis = "…";
  std::size_t end = 0;  // of the last word that fits
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = at + first_word(text.substr(at)).size();
    if (width_of(text.substr(0, next)) + 1 > width) break;
    if (next > at) end = next;
    at = next + 1;
  }
  return end == 0 ? "" : std::string(text.substr(0, end)) + std::string(kEllipsis);
}

}  // namespace gnbv
