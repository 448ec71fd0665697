#include "sim/mesh/ply_reader.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "sim/core/error.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

constexpr std::array kTypes = {
    PlyType{"char", "int8", 1, true, false},    PlyType{"uchar", "uint8", 1, false, false},
    PlyType{"short", "int16", 2, true, false},  PlyType{"ushort", "uint16", 2, false, false},
    PlyType{"int", "int32", 4, true, false},    PlyType{"uint", "uint32", 4, false, false},
    PlyType{"float", "float32", 4, true, true}, PlyType{"double", "float64", 8, true, true},
};

template <typename T>
double number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// Of bytes in this machine's order.
double number_of(const PlyType& type, const char* bytes) {
  if (type.is_real) return type.bytes == 4 ? number_at<float>(bytes) : number_at<double>(bytes);
  switch (type.bytes) {
    case 1:
      return type.is_signed ? number_at<std::int8_t>(bytes) : number_at<std::uint8_t>(bytes);
    case 2:
      return type.is_signed ? number_at<std::int16_t>(bytes) : number_at<std::uint16_t>(bytes);
    default:
      return type.is_signed ? number_at<std::int32_t>(bytes) : number_at<std::uint32_t>(bytes);
  }
}

}  // namespace

std::array<std::optional<std::size_t>, 3> PlyElement::columns(
    const std::array<std::string_view, 3>& names) const {
  std::array<std::optional<std::size_t>, 3> found;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (properties[i].count_type == nullptr && properties[i].name == names[k]) found[k] = i;
    }
  }
  return found;
}

PlyReader::PlyReader(const std::filesystem::path& path) : path_(path.string()), file_(path) {
  static_assert(std::endian::native == std::endian::little);
  read_header();
}

void PlyReader::fail(const std::string& what) const {
  throw BadInput(fmt::format("{}: {}", path_, what));
}

void PlyReader::read_header() {
  std::vector<std::string_view> words;
  split(file_.line().value_or(""), words);
  if (words.size() != 1 || words[0] != "ply") {
    fail("is no PLY file: its first line is not 'ply'");
  }
  while (true) {
    const auto line = file_.line();
    if (!line) fail("its header has no end_header");
    split(*line, words);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return;
    if (!read_declaration(words)) fail(fmt::format("its header has a bad '{}' line", words[0]));
  }
}

const PlyType* PlyReader::type_of(std::string_view name) const {
  for (const PlyType& type : kTypes) {
    if (name == type.name || name == type.other_name) return &type;
  }
  fail(fmt::format("its header names the unknown type '{}'", name));
}

bool PlyReader::read_declaration(const std::vector<std::string_view>& words) {
  const std::size_t n = words.size();
  if (words[0] == "format" && n >= 2) {
    constexpr std::array<std::string_view, 3> kEncodings = {"ascii", "binary_little_endian",
                                                            "binary_big_endian"};
    const auto found = std::find(kEncodings.begin(), kEncodings.end(), words[1]);
    encoding_ = static_cast<Encoding>(found - kEncodings.begin());
    return found != kEncodings.end();
  }
  if (words[0] == "element" && n == 3) {
    PlyElement& element = elements_.emplace_back();
    element.name = words[1];
    const char* const last = words[2].data() + words[2].size();
    const auto [end, error] = std::from_chars(words[2].data(), last, element.count);
    return error == std::errc() && end == last;
  }
  if (words[0] != "property" || elements_.empty()) return false;
  const bool is_list = n == 5 && words[1] == "list";
  if (n != 3 && !is_list) return false;
  elements_.back().properties.push_back(
      {std::string(words[n - 1]), type_of(words[n - 2]), is_list ? type_of(words[2]) : nullptr});
  return true;
}

double PlyReader::take_number(const PlyType& type) {
  constexpr const char* kTooShort = "ends before all that its header announces";
  if (encoding_ == Encoding::text) {
    const std::string_view word = file_.word();
    if (word.empty()) fail(kTooShort);
    const auto value = read_decimal(word);
    if (!value) fail(fmt::format("'{}' is no number", word.substr(0, 60)));
    return *value;
  }
  const char* const bytes = file_.bytes(type.bytes);
  if (bytes == nullptr) fail(kTooShort);
  if (encoding_ == Encoding::little_endian) return number_of(type, bytes);
  std::array<char, 8> turned{};
  std::reverse_copy(bytes, bytes + type.bytes, turned.begin());
  return number_of(type, turned.data());
}

void PlyReader::read_item(const PlyElement& element, PlyItem& item) {
  item.numbers.resize(element.properties.size());
  item.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.count_type == nullptr) {
      item.numbers[i] = take_number(*property.type);
      continue;
    }
    item.lists[i].clear();
    const double count = take_number(*property.count_type);
    for (double k = 0.0; k < count; k += 1.0) item.lists[i].push_back(take_number(*property.type));
  }
}

void PlyReader::skip(const PlyElement& element) {
  if (element.properties.empty()) return;
  PlyItem item;
  for (std::uint64_t i = 0; i < element.count; ++i) read_item(element, item);
}

std::size_t PlyReader::least_bytes(const PlyType& type) const {
  return encoding_ == Encoding::text ? 2 : type.bytes;
}

std::size_t PlyReader::least_bytes(const PlyElement& element) const {
  std::size_t sum = 0;
  for (const PlyProperty& property : element.properties) {
    sum += least_bytes(property.count_type != nullptr ? *property.count_type : *property.type);
  }
  return std::max<std::size_t>(sum, 1);
}

std::size_t PlyReader::most_items(const PlyElement& element) const {
  return std::min<std::uint64_t>(element.count, file_.bytes_left() / least_bytes(element) + 1);
}

std::size_t PlyReader::most_list_numbers(const PlyElement& element) const {
  const std::uint64_t of_items = most_items(element) * least_bytes(element);
  const std::uint64_t left = file_.bytes_left() - std::min(of_items, file_.bytes_left());
  std::size_t least = 8;
  for (const PlyProperty& property : element.properties) {
    if (property.count_type != nullptr) least = std::min(least, least_bytes(*property.type));
  }
  return left / least + 1;
}

}  // namespace gnbv
