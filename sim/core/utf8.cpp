#include "sim/core/utf8.hpp"

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

}  // namespace gnbv
