// Words and decimal numbers of plain text, the same in every locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

using Words = std::span<const std::string_view>;

/// Cuts the first word off a text, with the blanks before it; empty at its end.
std::string_view take_word(std::string_view& text);

/// The words of a line.
void split(std::string_view line, std::vector<std::string_view>& words);

/// The part of a line from the first of the words to the last.
std::string joined(Words words);

/// The number that is all of `word`; nothing when it is none. One plus may stand before it. What is
/// too large for a double is infinite, what is too small is 0; "inf" and "nan" are numbers.
std::optional<double> read_decimal(std::string_view word);

}  // namespace gnbv
