// Text as code points.
#pragma once

#include <string>
#include <string_view>

namespace gnbv {

/// Takes the first code point off `text`, which is not empty. Of bytes that are no UTF-8 (RFC 3629)
/// it takes one, and U+FFFD, the replacement character, stands for it.
char32_t take_code_point(std::string_view& text);

/// For a terminal: control bytes, but for newlines and tabs, and bytes that are no UTF-8 as \\x1b.
std::string printable(std::string_view text);

}  // namespace gnbv
