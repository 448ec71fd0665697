#include "sim/core/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <cwchar>
#include <locale>

namespace gnbv {

char32_t take_code_point(std::string_view& text) {
  using Utf8 = std::codecvt<char32_t, char8_t, std::mbstate_t>;
  static const Utf8& utf8 = std::use_facet<Utf8>(std::locale::classic());
  std::array<char8_t, 4> bytes{};
  const std::size_t count = std::min(text.size(), bytes.size());
  std::memcpy(bytes.data(), text.data(), count);
  const char8_t* next = bytes.data();
  char32_t code = 0;
  char32_t* end = &code;
  std::mbstate_t state{};
  // it stops after one code point, for want of room, or at bytes that are none
  utf8.in(state, bytes.data(), bytes.data() + count, next, &code, &code + 1, end);
  const bool is_code = end != &code && (code < 0xd800 || code > 0xdfff);
  text.remove_prefix(is_code ? static_cast<std::size_t>(next - bytes.data()) : 1);
  return is_code ? code : U'\ufffd';
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t code = take_code_point(text);
    const std::string_view bytes = before.substr(0, before.size() - text.size());
    const bool is_usual = code >= 0x20 || code == U'\n' || code == U'\t';
    const bool is_control =
        !is_usual || (code >= 0x7f && code < 0xa0) || (code == U'\ufffd' && bytes.size() == 1);
    if (!is_control) {
      shown += bytes;
      continue;
    }
    for (const char byte : bytes) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    }
  }
  return shown;
}

}  // namespace gnbv
