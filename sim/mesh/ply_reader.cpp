#include "sim/mesh/ply_reader.hpp"

#include <bit>
#include <cmath>
#include <iterator>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

template <typename T>
constexpr PlyType ply_type(std::string_view name, std::string_view other_name, double full) {
  return {name, other_name, sizeof(T), full,
          [](const char* at) { return static_cast<double>(number_at<T>(at)); }};
}

constexpr std::array kTypes = {
    ply_type<std::int8_t>("char", "int8", 255.0),
    ply_type<std::uint8_t>("uchar", "uint8", 255.0),
    ply_type<std::int16_t>("short", "int16", 65535.0),
    ply_type<std::uint16_t>("ushort", "uint16", 65535.0),
    ply_type<std::int32_t>("int", "int32", 4294967295.0),
    ply_type<std::uint32_t>("uint", "uint32", 4294967295.0),
    ply_type<float>("float", "float32", 1.0),
    ply_type<double>("double", "float64", 1.0),
};

}  // namespace

PlyFile::PlyFile(const std::filesystem::path& path) : path_(path.string()), in_(open_file(path)) {
  static_assert(std::endian::native == std::endian::little);
  std::error_code ignored;  // of a pipe
  const auto size = std::filesystem::file_size(path, ignored);
  if (!ignored) bytes_ = size;
  read_header();
}

std::size_t PlyFile::warn_of_rest(std::vector<std::string>& warnings) {
  std::size_t count = 0;
  if (is_text_) {
    do {
      count += take_word(rest_).empty() ? 0 : 1;
      if (is_free() && count > 0) fail_in_line("more words than its header announces");
    } while (lines_->next(rest_));
  } else {
    in().ignore(std::numeric_limits<std::streamsize>::max());
    count = static_cast<std::size_t>(in().gcount());
  }
  constexpr std::size_t kBlanks = 2, kFace = 13;  // bytes
  if (count <= (is_text_ ? 0 : kBlanks)) return 0;
  warnings.push_back(fmt::format("{}: {} {} after all that its header announces left out", path_,
                                 count, is_text_ ? "rows" : "bytes"));
  return is_text_ ? count : count / kFace;
}

void PlyFile::fail(const std::string& what) const {
  throw BadInput("{}: {}", path_, printable(what));
}

void PlyFile::fail_in_line(const std::string& what) const {
  if (lines_ && !is_text_) fail(what);  // among bytes
  const std::size_t row = lines_ ? lines_->number() : 0;
  throw BadInput("{}:{}: {}", path_, header_lines_ + row, printable(what));
}

void PlyFile::need_whole_numbers(std::span<const double> values, double least,
                                 const PlyProperty& list) const {
  for (const double value : values) {
    if (value >= least && value == std::floor(value)) continue;
    fail_in_line(fmt::format("'{}' has {} where a whole number belongs", list.name, value));
  }
}

void PlyFile::end_row(const PlyElement& element) {
  std::string_view left = rest_;
  const std::string_view word = is_text_ ? take_word(left) : "";
  if (!is_free_) is_free_ = !word.empty();
  if (word.empty() || *is_free_) return;
  fail_in_line(fmt::format("a row of '{}' has more words than the header says, from '{}' on",
                           element.name, word.substr(0, 60)));
}

bool PlyFile::next_header_line() {
  line_.clear();
  ++header_lines_;
  for (char c = '\0'; in().get(c); line_ += c) {
    if (c == '\r' && (header_lines_ == 1 || !ends_in_cr_) && in().peek() == '\n') in().get(c);
    if (c != '\n' && c != '\r') continue;
    if (header_lines_ == 1) ends_in_cr_ = c == '\r';
    return true;
  }
  return !line_.empty();
}

void PlyFile::read_header() {
  std::vector<std::string_view> words;
  next_header_line();
  if (is_utf16(line_)) {
    line_ += ends_in_cr_ ? '\r' : '\n';
    line_.append(std::istreambuf_iterator<char>(in_), {});
    converted_.emplace(as_utf8(std::move(line_)));
    header_lines_ = 0;
    next_header_line();
  }
  line_ = as_utf8(std::move(line_));
  need_whole(in_, path_);
  split(line_, words);
  if (words.size() != 1 || words[0] != "ply") fail("is no PLY file: its first line is not 'ply'");
  while (next_header_line()) {
    split(line_, words);
    if (words.size() > 2 && words[0] == "comment" && words[1] == "TextureFile") {
      picture_ = joined(Words(words).subspan(2));
    }
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      lines_.emplace(in());
      return;
    }
    if (!read_declaration(words)) {
      fail_in_line(fmt::format("its header has a bad '{}' line", words[0].substr(0, 60)));
    }
  }
  need_whole(in_, path_);
  fail("its header has no end_header");
}

bool PlyFile::read_declaration(Words words) {
  const std::size_t n = words.size();
  if (words[0] == "format" && n >= 2) {
    is_text_ = words[1] == "ascii";
    is_big_endian_ = words[1] == "binary_big_endian";
    return is_text_ || is_big_endian_ || words[1] == "binary_little_endian";
  }
  if (words[0] == "element" && n == 3) {
    PlyElement& element = elements_.emplace_back();
    element.name = in_lower_case(words[1]);
    const auto count = number_in<std::uint64_t>(words[2]);
    element.count = count.value_or(0);
    return count.has_value();
  }
  if (words[0] != "property" || elements_.empty()) return false;
  const bool is_list = n == 5 && words[1] == "list";
  if (n != 3 && !is_list) return false;
  elements_.back().properties.push_back(
      {in_lower_case(words[n - 1]), type_of(words[n - 2]), is_list ? type_of(words[2]) : nullptr});
  return true;
}

const PlyType* PlyFile::type_of(std::string_view name) const {
  for (const PlyType& type : kTypes) {
    if (name == type.name || name == type.other_name) return &type;
  }
  fail_in_line(fmt::format("its header names the unknown type '{}'", name.substr(0, 60)));
}

void PlyFile::take_numbers(const PlyType& type, double count, bool is_needed,
                           std::vector<double>& numbers) {
  std::array<char, 16 * sizeof(double)> bytes;
  numbers.clear();
  std::size_t piece = 1;
  auto left = static_cast<std::size_t>(std::ceil(count > 0.0 ? std::min(count, 1e18) : 0.0));
  for (; left > 0; left -= piece) {
    if (is_text_) {
      numbers.push_back(take_number(is_needed));
      continue;
    }
    piece = std::min<std::size_t>(left, 16);
    if (!in().read(bytes.data(), static_cast<std::streamsize>(piece * type.bytes))) end_early();
    for (std::size_t i = 0; i < piece; ++i) {
      char* const first = bytes.data() + i * type.bytes;
      if (is_big_endian_) std::reverse(first, first + type.bytes);
      numbers.push_back(type.number_at(first));
    }
  }
}

double PlyFile::take_number(bool is_needed) {
  std::string_view word;
  while ((word = take_word(rest_)).empty()) {
    if (!lines_->next(rest_)) end_early();
  }
  const auto value = read_decimal(word);
  if (!value && is_needed) fail_in_line(fmt::format("'{}' is no number", word.substr(0, 60)));
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

void PlyFile::end_early() const {
  need_whole(in_, path_);
  fail("ends before all that its header announces");
}

}  // namespace gnbv
