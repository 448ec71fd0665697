// Words, lines and decimal numbers of text, the same in every locale and encoding; numbers in
// bytes.
#pragma once

#include <cstring>
#include <istream>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

using Words = std::span<const std::string_view>;

/// Cuts the first word off a text, with the blanks and line ends before it; empty at its end.
std::string_view take_word(std::string_view& text);

/// Without the blanks and line ends around it.
std::string trimmed(const std::string& text);

/// The words of a line.
void split(std::string_view line, std::vector<std::string_view>& words);

/// The part of a line from the first of the words to the last.
std::string joined(Words words);

/// The number that is all of `word`; nothing when it is none. One plus may stand before it. What is
/// too large for a double is infinite, what is too small is 0; "inf" and "nan" are numbers.
std::optional<double> read_decimal(std::string_view word);

/// The number whose bytes, the lowest first, begin there.
template <typename T>
T number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Whether a text that begins so is UTF-16: by its byte order mark or, without one, by two first
/// characters of ASCII.
bool is_utf16(std::string_view head);

/// A text as UTF-8 without a byte order mark. What is no UTF-16 stays as it is.
std::string as_utf8(std::string bytes);

/// In lower case, by ASCII.
std::string in_lower_case(std::string_view text);

/// Each %41 becomes its byte (RFC 3986).
std::string percent_decoded(std::string_view text);

/// The lines of a text, as UTF-8 (as_utf8()), whether LF, CR LF or CR ends them.
class LineReader {
 public:
  explicit LineReader(std::istream& in) : in_(&in) {}

  /// The next line, until the one after it; false at the end.
  bool next(std::string_view& line);
  /// Of that line, from 1; a lone CR ends a line that counts where it ends the first.
  std::size_t number() const { return number_; }

 private:
  bool fetch();

  std::istream* in_;
  std::istringstream converted_;  // from UTF-16
  std::string chunk_;             // up to a line feed
  std::size_t at_ = 1;            // in it; beyond its end: used up
  std::size_t number_ = 0;
  bool is_first_ = true;
  bool counts_cr_ = false;
};

}  // namespace gnbv
