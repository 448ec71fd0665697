#include "sim/core/text.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <boost/locale/utf.hpp>
#include <cctype>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

std::string with_commas(std::string digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t i = point; i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

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

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", grouped(count), thing, count == 1 ? "" : "s");
}

std::string human_name(std::string_view name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  std::string words(name);
  if (!is_plain || name.empty()) return words;
  if (name == "aep") return "AEP";
  std::replace(words.begin(), words.end(), '_', ' ');
  words.front() = static_cast<char>(std::toupper(words.front()));
  return words;
}

std::string grouped(std::size_t count) { return with_commas(std::to_string(count)); }

std::string grouped(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = digits.find_first_of("123456789") == std::string::npos;
  return (value < 0.0 && !is_zero ? "-" : "") + with_commas(digits);
}

double rounded_up_125(double value) {
  constexpr double kRounding = 1e-9;
  const double power = std::pow(10.0, std::floor(std::log10(value) + kRounding));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value <= (factor + kRounding) * power) return factor * power;
  }
  return 10.0 * power;
}

double rounded_down_125(double value) { return 1.0 / rounded_up_125(1.0 / value); }

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
    if (used > 0) {
      const bool fits = used + 1 + width_of(word) <= width;
      folded += fits ? ' ' : '\n';
      used = fits ? used + 1 : 0;
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

char32_t take_code_point(std::string_view& text) {
  const char* next = text.data();
  const auto code = boost::locale::utf::utf_traits<char>::decode(next, next + text.size());
  const bool is_code = boost::locale::utf::is_valid_codepoint(code);
  text.remove_prefix(is_code ? static_cast<std::size_t>(next - text.data()) : 1);
  return is_code ? code : U'\ufffd';
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t code = take_code_point(text);
    const std::string_view bytes = before.substr(0, before.size() - text.size());
    const bool is_hidden = (code < 0x20 && code != U'\n' && code != U'\t') ||
                           (code >= 0x7f && code < 0xa0) ||
                           (code == U'\ufffd' && bytes.size() == 1);
    if (!is_hidden) shown += bytes;
    for (const char byte : is_hidden ? bytes : "") {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    }
  }
  return shown;
}

std::string escaped(std::string_view text, Escapes escapes) {
  std::string all;
  while (!text.empty()) {
    const auto escape = std::find_if(escapes.begin(), escapes.end(),
                                     [&](const auto& e) { return text.starts_with(e.first); });
    const bool is_plain = escape == escapes.end();
    all += is_plain ? text.substr(0, 1) : escape->second;
    text.remove_prefix(is_plain ? 1 : escape->first.size());
  }
  return all;
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:+-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr int kMax = std::numeric_limits<int>::max() / 4 * 3 - 3;  // OpenSSL counts in int
  GNBV_CHECK(bytes.size() <= kMax, "{} bytes in one text", bytes.size());
  std::string text((bytes.size() + 2) / 3 * 4, '\0');  // OpenSSL writes the zero after it, too
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace gnbv
