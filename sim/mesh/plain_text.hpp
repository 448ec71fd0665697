// Words and decimal numbers of plain text, the same in every locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

using Words = std::span<const std::string_view>;

/// The words of a line between its blanks.
void split(std::string_view line, std::vector<std::string_view>& words);

/// What the words are, from the first to the last of them, the blanks of their line in between.
std::string joined(Words words);

/// The number that is all of `word`; nothing when it is none. One plus may stand before it. What is
/// too large for a double is infinite, what is too small 0; "inf" and "nan" are what they say.
std::optional<double> read_decimal(std::string_view word);

}  // namespace gnbv
