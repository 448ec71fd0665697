// Text for people, terminals, shells and other files.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace gnbv {

/// "1 face repeats" or "3 faces repeat".
std::string counted(std::size_t count, std::string_view one, std::string_view many);

/// "1 view", "12 views", "1,200 views".
std::string counted(std::size_t count, std::string_view thing);

/// Of a scenario, a utility or a preset: "Power plant" for "power_plant", "AEP" for "aep". What is
/// no plain name of ours (lower case, digits, underscores), a file of the user's for one, stays.
std::string human_name(std::string_view name);

/// "1,234,567".
std::string grouped(std::size_t count);

/// With so many decimals: "10,970", "-1,234.5"; never "-0".
std::string grouped(double value, int decimals);

/// Where a scale of amounts may end: the least of 1, 2 or 5 times a power of ten that reaches the
/// value, or the greatest that it reaches. Requires one above 0.
double rounded_up_125(double value);
double rounded_down_125(double value);

/// Width of UTF-8 text on a terminal: its code points.
std::size_t width_of(std::string_view text);

/// Up to the first blank or line feed. A number and its unit ("38 s") are one word.
std::string_view first_word(std::string_view text);

/// Folded at blanks into lines of at most `width` code points, where the words allow it; 0: as it
/// is. Line feeds stay.
std::string folded_text(std::string_view text, std::size_t width);

/// Text wider than that is cut after a word and ends in an ellipsis; empty where no word fits.
std::string shortened(std::string_view text, std::size_t width);

/// Takes the first code point off `text`, which is not empty. A byte that is no UTF-8 (RFC 3629)
/// becomes U+FFFD, the replacement character.
char32_t take_code_point(std::string_view& text);

/// For a terminal: control bytes (but newlines and tabs) and bytes that are no UTF-8 become \\x1b.
std::string printable(std::string_view text);

/// What a form of text writes instead of some signs, each of them one code point or more.
using Escapes = std::span<const std::pair<std::string_view, std::string_view>>;

/// With the first of the signs that the text goes on with in its other form, wherever one does.
std::string escaped(std::string_view text, Escapes escapes);

/// Quoted as one word of a shell command where that is needed.
std::string shell_word(const std::string& text);

/// The number that is all of a text, in the same digits in every locale; nothing for any other
/// text, or for a number that is out of range.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && last == end ? std::optional(number) : std::nullopt;
}

/// RFC 4648, padded.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace gnbv
