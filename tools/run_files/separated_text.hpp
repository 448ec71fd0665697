// Text files of numbers in columns, with errors that name file and line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gnbv {

/// Without blanks at either end.
std::string_view trimmed(std::string_view text);

/// Cuts off and returns the part before the next `separator`; all of it without one.
std::string_view next_part(std::string_view& rest, char separator);

/// `FILE:LINE`, as errors begin.
struct TextPlace {
  const std::filesystem::path& file;
  int line;
};
std::string to_string(const TextPlace& place);

/// The finite number that is all of the text. Throws BadInput naming place, `what` and text.
double to_number(std::string_view text, const TextPlace& place, std::string_view what);

/// The same for a count: whole, and from 0 to 10^9.
int to_count(std::string_view text, const TextPlace& place, std::string_view what);

}  // namespace gnbv
