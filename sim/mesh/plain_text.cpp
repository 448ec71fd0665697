#include "sim/mesh/plain_text.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <utility>

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

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

void append_code_point(std::string& out, char32_t code) {
  const auto tail = [&](unsigned shift) {
    out += static_cast<char>(0x80U | (code >> shift & 0x3FU));
  };
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0U | code >> 6U);
    tail(0);
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0U | code >> 12U);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0U | code >> 18U);
    tail(12);
    tail(6);
    tail(0);
  }
}

}  // namespace

std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
}

std::string trimmed(const std::string& text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
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

bool is_utf16(std::string_view head) {
  if (head.size() < 2) return false;
  const bool has_mark = head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF");
  if (has_mark || head.size() < 4) return has_mark;
  const auto is_wide = [&](std::size_t zero) {  // two characters with a zero before or after each
    return head[zero] == '\0' && head[zero + 2] == '\0' && head[1 - zero] > '\0' &&
           head[3 - zero] > '\0';
  };
  return is_wide(0) || is_wide(1);
}

std::string as_utf8(std::string bytes) {
  if (bytes.starts_with(kUtf8Mark)) return bytes.substr(kUtf8Mark.size());
  if (!is_utf16(bytes)) return bytes;
  const std::size_t high = bytes.starts_with("\xFE\xFF") || bytes[0] == '\0' ? 0 : 1;
  const auto unit_at = [&](std::size_t i) -> char32_t {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[i + k]); };
    return static_cast<char32_t>(byte(high) << 8U | byte(1 - high));
  };
  std::string out;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t code = unit_at(i);
    const char32_t low = i + 3 < bytes.size() ? unit_at(i + 2) : 0;
    if (code >= 0xD800 && code < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
      i += 2;
    }
    if (code != 0xFEFF || i > 0) append_code_point(out, code);
  }
  return out;
}

std::string in_lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                         std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    out += is_code ? static_cast<char>(value) : text[i];
    if (is_code) i += 2;
  }
  return out;
}

bool LineReader::fetch() {
  if (!std::getline(*in_, chunk_)) return false;
  const bool is_first = std::exchange(is_first_, false);
  if (is_first) {
    if (is_utf16(chunk_)) {
      chunk_ += '\n';
      chunk_.append(std::istreambuf_iterator<char>(*in_), {});
      converted_.str(as_utf8(std::move(chunk_)));
      in_ = &converted_;
      is_first_ = true;
      return fetch();
    }
    chunk_ = as_utf8(std::move(chunk_));
  }
  while (chunk_.ends_with('\r')) chunk_.pop_back();
  if (is_first) counts_cr_ = chunk_.find('\r') != chunk_.npos;
  number_ += counts_cr_ ? 0 : 1;
  return true;
}

bool LineReader::next(std::string_view& line) {
  if (at_ > chunk_.size()) {
    if (!fetch()) return false;
    at_ = 0;
  }
  const std::size_t end = std::min(chunk_.find('\r', at_), chunk_.size());
  line = std::string_view(chunk_).substr(at_, end - at_);
  at_ = end + 1;
  number_ += counts_cr_ ? 1 : 0;
  return true;
}

}  // namespace gnbv
