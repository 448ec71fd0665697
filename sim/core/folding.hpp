// Text in the lines of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gnbv {

/// Width on a terminal of UTF-8 text: its code points.
std::size_t width_of(std::string_view text);

/// Up to the first blank or line feed that a line may end at: a number and its unit ("38 s") are
/// one word.
std::string_view first_word(std::string_view text);

/// Lines of at most `width` code points where blanks allow it; 0: as it is. Line feeds stay.
std::string folded_text(std::string_view text, std::size_t width);

/// Cut after a word, with an ellipsis, where it is wider than that; empty where no word fits.
std::string shortened(std::string_view text, std::size_t width);

}  // namespace gnbv
